// The playhead: the one frame the page shows, and playback. Everything that shows time listens here; nothing else keeps a frame.

export class Playhead {
  #listeners = new Set();
  #last = 0;

  /** `ready(frame)`: false holds the playhead, so that playback never runs ahead of what has been fetched. */
  constructor(frames, rate, ready = () => true) {
    Object.assign(this, { frames, rate, ready, position: 0, speed: 1, playing: false, held: false, loop: null, until: null });
  }

  get frame() { return Math.min(this.frames - 1, Math.floor(this.position + 1e-6)); }

  listen(listener) { this.#listeners.add(listener); return () => this.#listeners.delete(listener); }

  seek(frame) {
    this.position = Math.max(0, Math.min(this.frames - 1, frame));
    if (this.loop && (this.frame < this.loop[0] || this.frame >= this.loop[1])) this.loop = null;
    this.notify();
  }

  toggle(playing = !this.playing) {
    this.until = null;
    this.#run(playing);
  }

  /** Play [start, end) once, at normal speed, then come to rest at `rest`. No listener takes `start` for a place to stay. */
  playOnce(start, end, rest) {
    this.loop = null;
    this.position = Math.max(0, start);
    this.until = { end: Math.min(end, this.frames - 1), rest };
    this.#run(true);
  }

  notify() { for (const listener of this.#listeners) listener(this); }

  #run(playing) {
    if (playing === this.playing) return;
    if (playing && !this.loop && this.position >= this.frames - 1) this.position = 0;
    this.playing = playing;
    this.#last = 0;
    if (playing) requestAnimationFrame((now) => this.#tick(now));
    this.notify();
  }

  #tick(now) {
    if (!this.playing) return;
    // A tab that slept must not jump: at most a tenth of a second passes at once.
    const passed = this.#last ? Math.min(0.1, (now - this.#last) / 1000) : 0;
    this.#last = now;
    const [start, end] = this.loop || [0, this.frames];
    let next = this.position + passed * this.rate * (this.until ? 1 : this.speed);
    const done = this.until && next >= this.until.end;
    if (done) {
      next = this.until.rest;
      this.playing = false;
    } else if (next >= end - (this.loop ? 0 : 1)) {
      if (this.loop) next = start + ((next - start) % Math.max(1, end - start));
      else { next = this.frames - 1; this.playing = false; }
    }
    this.held = !this.ready(Math.floor(next));
    if (this.held) this.playing = true;
    else {
      this.position = next;
      if (done) this.until = null;
    }
    this.notify();
    if (this.playing) requestAnimationFrame((later) => this.#tick(later));
  }
}
