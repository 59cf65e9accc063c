// Saving edits: the service gets one revision for all edits of a moment, and the page knows which edits are saved.

import * as api from '../service/api.js';
import { mayPass, pauseBefore } from '../service/retry.js';
import { sameSegments } from './segment_edits.js';

const QUIET = 600; // ms without another edit before they are sent
const LONGEST_NOTE = 200;

/**
 * `kind` is `saved` (no edit is open), `waiting` (edits are not sent yet), `saving`, `failed` (`why` gives the reason) or
 * `stale` (somebody else has saved revision `theirs` since). `onState()` is called whenever it changes. A save that failed for a
 * reason that may pass is tried again by itself.
 */
export class RevisionSaving {
  #id; #onState; #onSaved; #kept; #wanted = null; #notes = []; #timer = 0; #sending = null; #failures = 0;

  /**
   * `segments` are those of revision `shown`; `newest` is the number an edit must be made against. `onSaved(segments)` is called
   * with those of a new revision as the service has them.
   */
  constructor({ id, segments, shown, newest, onState, onSaved }) {
    Object.assign(this, { shown, newest, kind: 'saved', theirs: null, why: '', again: false });
    this.#onSaved = onSaved;
    this.#id = id;
    this.#kept = segments;
    this.#onState = onState;
  }

  /** Whether edits are lost if the page closes now. */
  get open() { return this.kind !== 'saved'; }

  /** Save these segments soon; `note` says what was edited. Segments that are saved already make no revision. */
  schedule(segments, note) {
    clearTimeout(this.#timer);
    this.#wanted = segments;
    if (this.#notes.at(-1) !== note) this.#notes.push(note);
    if (this.#sending || this.kind === 'stale') return;
    if (sameSegments(segments, this.#kept)) return this.#setKind('saved');
    this.#setKind('waiting');
    this.#timer = setTimeout(() => this.flush().catch(() => {}), QUIET);
  }

  /** Send open edits now. Resolves once they are saved; throws if the service cannot save them. */
  flush() {
    clearTimeout(this.#timer);
    this.#sending ||= this.#send().finally(() => { this.#sending = null; });
    return this.#sending;
  }

  /** Save these edits on top of the revision that somebody else has saved. */
  overwrite() {
    this.newest = this.theirs;
    return this.flush();
  }

  close() { clearTimeout(this.#timer); }

  async #send() {
    while (this.#wanted && !sameSegments(this.#wanted, this.#kept)) {
      const segments = this.#wanted;
      const notes = [...this.#notes];
      this.#setKind('saving');
      try {
        const answer = await api.revise(this.#id, segments, this.newest, notes.join(', ').slice(0, LONGEST_NOTE));
        this.#kept = segments;
        this.#notes = this.#notes.slice(notes.length);
        this.shown = this.newest = answer.revision;
        this.#failures = 0;
        if (this.#wanted === segments) this.#onSaved(answer.segments);
      } catch (problem) {
        if (problem.document?.status === 412) {
          this.theirs = problem.document.current ?? (await api.status(this.#id)).revision;
          this.#setKind('stale');
        } else {
          this.why = problem.message;
          this.again = mayPass(problem);
          if (this.again) this.#timer = setTimeout(() => this.flush().catch(() => {}), pauseBefore(this.#failures++));
          this.#setKind('failed');
        }
        throw problem;
      }
    }
    this.#setKind('saved');
  }

  #setKind(kind) {
    this.kind = kind;
    this.#onState();
  }
}
