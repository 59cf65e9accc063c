// The frames that a person has looked at in the review of a result, remembered in this browser.

import { store, stored } from '../local_storage.js';

export class CheckedFrames {
  #key; #frames;

  /** Of the result `id`. A cut is known by its frame. */
  constructor(id) {
    this.#key = `caesura.checked.${id}`;
    this.#frames = new Set(stored(this.#key, []));
  }

  has(frame) { return this.#frames.has(frame); }

  /** Mark a frame, or take its mark away. Answers whether it is marked now. */
  toggle(frame) {
    const marked = !this.has(frame);
    if (marked) this.#frames.add(frame); else this.#frames.delete(frame);
    store(this.#key, [...this.#frames]);
    return marked;
  }
}
