// Which cuts of a result a person has checked, remembered in this browser. A cut is known by its frame.

import { stored, store } from '../local_storage.js';

export class Checked {
  #key; #frames;

  /** Those of the result `id`. */
  constructor(id) {
    this.#key = `caesura.checked.${id}`;
    this.#frames = new Set(stored(this.#key, []));
  }

  has(frame) { return this.#frames.has(frame); }

  /** Mark a cut, or take its mark away. Answers whether it is marked now. */
  toggle(frame) {
    const marked = !this.has(frame);
    if (marked) this.#frames.add(frame); else this.#frames.delete(frame);
    store(this.#key, [...this.#frames]);
    return marked;
  }
}
