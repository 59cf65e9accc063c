// Undo and redo over values that never change in place.

export class UndoHistory {
  #past = []; #future = []; #key = null;

  constructor(present) { this.present = present; }

  get canUndo() { return this.#past.length > 0; }

  get canRedo() { return this.#future.length > 0; }

  /** Go on to `next`. Steps in a row with the same `key` (a cut nudged five times) are undone as one. */
  push(next, key = null) {
    if (next === this.present) return false;
    if (key === null || key !== this.#key) this.#past.push(this.present);
    this.#key = key;
    this.#future = [];
    this.present = next;
    return true;
  }

  /** The next push is a step of its own, whatever its key. */
  endStep() { this.#key = null; }

  /** Put `present` right without a step: nothing that a person did changes. */
  amend(present) { this.present = present; }

  /** Take back the last step if it has this `key`; it cannot be redone. */
  drop(key) {
    if (key !== this.#key) return false;
    this.present = this.#past.pop();
    this.#key = null;
    return true;
  }

  undo() { return this.#step(this.#past, this.#future); }

  redo() { return this.#step(this.#future, this.#past); }

  #step(from, to) {
    if (!from.length) return false;
    to.push(this.present);
    this.present = from.pop();
    this.#key = null;
    return true;
  }
}
