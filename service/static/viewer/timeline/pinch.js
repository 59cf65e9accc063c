// Two fingers on a range of frames: they zoom and pan it.

const CLOSE = 0.02; // share of the width below which two fingers do not zoom

/** Apart and together they zoom, aside they pan. The frames under them stay under them. */
export class Pinch {
  #range; #fingers = new Map();

  constructor(range) { this.#range = range; }

  get on() { return this.#fingers.size > 1; }

  /** A finger comes down at a share of the width: from now on each holds the frame it is on. */
  press(id, share) {
    this.#fingers.set(id, { share });
    for (const finger of this.#fingers.values()) finger.frame = this.#range.from + finger.share * this.#range.length;
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
    this.#range.set(from, from + length);
  }

  release(id) { this.#fingers.delete(id); }
}
