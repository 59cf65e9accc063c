// The range of frames on screen: zoom and pan. The curve and the track of segments share it, so they always agree.

const FEWEST = 8; // frames; nearer than this there is nothing to see

export class VisibleRange {
  #listeners = new Set();

  constructor(frames) {
    this.frames = frames;
    this.from = 0;
    this.to = frames;
  }

  listen(listener) { this.#listeners.add(listener); }

  get length() { return this.to - this.from; }

  set(from, to) {
    const length = Math.max(Math.min(FEWEST, this.frames), Math.min(this.frames, to - from));
    from = Math.max(0, Math.min(this.frames - length, from));
    if (from === this.from && from + length === this.to) return;
    this.from = from;
    this.to = from + length;
    for (const listener of this.#listeners) listener(this);
  }

  showAll() { this.set(0, this.frames); }

  /** Zoom by `factor`, keeping `frame` where it is on screen. */
  zoom(factor, frame) {
    const length = this.length / factor;
    if (length >= this.frames) return this.showAll();
    const share = (frame - this.from) / this.length;
    const kept = Math.max(FEWEST, length);
    this.set(frame - share * kept, frame + (1 - share) * kept);
  }

  pan(frames) { this.set(this.from + frames, this.to + frames); }

  /** Bring `frame` on screen if it is not, with a little room before it. */
  reveal(frame) {
    if (frame >= this.from && frame < this.to) return;
    this.set(frame - this.length * 0.1, frame + this.length * 0.9);
  }

  /** While it plays, move on by pages: a curve that crawls cannot be read. */
  follow(frame) {
    const passed = frame >= this.to - 1 && this.to < this.frames;
    if (passed || frame < this.from) this.set(frame, frame + this.length);
  }
}
