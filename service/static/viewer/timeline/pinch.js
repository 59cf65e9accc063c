// Two fingers on a span of frames: apart and together zooms, aside moves. The frames under them stay under them.

const CLOSE = 0.02; // share of the width below which two fingers say nothing of how far to zoom

export class Pinch {
  #span; #fingers = new Map();

  constructor(span) { this.#span = span; }

  get on() { return this.#fingers.size > 1; }

  /** A finger comes down at a share of the width: from now on each holds the frame it is on. */
  press(id, share) {
    this.#fingers.set(id, { share });
    for (const finger of this.#fingers.values()) finger.frame = this.#span.from + finger.share * this.#span.length;
  }

  /** A finger moves. */
  move(id, share) {
    const finger = this.#fingers.get(id);
    if (!finger) return;
    finger.share = share;
    if (!this.on) return;
    const fingers = [...this.#fingers.values()].sort((one, other) => one.share - other.share);
    const [left, right] = [fingers[0], fingers.at(-1)]; // of three, the outer ones
    if (right.share - left.share < CLOSE || right.frame <= left.frame) return;
    const length = (right.frame - left.frame) / (right.share - left.share);
    const from = left.frame - left.share * length;
    this.#span.set(from, from + length);
  }

  release(id) { this.#fingers.delete(id); }
}
