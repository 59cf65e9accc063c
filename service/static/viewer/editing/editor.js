// Editing a result: what is selected, what was done, and that it is kept. Every edit goes through `#do`.

import { shownFrame } from '../number_format.js';
import { announce } from '../dom.js';
import { History } from './undo_history.js';
import { Saving } from './revision_saving.js';
import * as edits from './segment_edits.js';

export class Editor {
  #history; #result; #listener; #drag = 0;

  /** `result` shows; `newest` is the newest revision there is; `onChange()` hears of edits, selection and saving. */
  constructor(result, { newest, onChange }) {
    const { id, revision = 0, segments } = result.document;
    this.cut = -1;
    this.#result = result;
    this.#listener = onChange;
    this.#history = new History(segments);
    this.saving = new Saving({ id, segments, shown: revision, newest, onState: onChange });
  }

  get segments() { return this.#history.present; }

  get canUndo() { return this.#history.canUndo; }

  get canRedo() { return this.#history.canRedo; }

  /** The segment that the moment is in. */
  get here() { return edits.indexAt(this.segments, this.#result.clock.frame); }

  /** Select a cut (-1: none), and bring the moment to it. */
  select(cut) {
    const chosen = cut >= 0 && cut < this.segments.length - 1 ? cut : -1;
    if (chosen === this.cut) return;
    this.#history.settle();
    this.cut = chosen;
    if (chosen >= 0) this.#toCut();
    this.#result.selected(chosen);
    this.#listener();
  }

  /** The cut before or after the moment, or the selected one. */
  selectNext(by) {
    const from = this.cut >= 0 ? this.cut + by : this.here - (by < 0 ? 1 : 0);
    this.select(Math.max(0, Math.min(this.segments.length - 2, from)));
  }

  /** A drag begins: all its steps are one edit. */
  grab(cut) {
    this.#drag += 1;
    this.select(cut);
  }

  /** Where the drag has come to; shown at once, kept when it is over. */
  drag(frame) { this.#do(edits.moveCut(this.segments, this.cut, frame), { key: `drag ${this.#drag}`, keep: false }); this.#toCut(); }

  drop() {
    this.#history.settle();
    this.saving.want(this.segments, 'moved a cut');
    this.#tellCut();
  }

  /** Move the selected cut to a frame, or by some. */
  place(frame) {
    if (this.cut < 0) return;
    this.#do(edits.moveCut(this.segments, this.cut, frame), { key: `nudge ${this.cut}`, note: 'moved a cut' });
    this.#toCut();
    this.#tellCut();
  }

  nudge(by) { if (this.cut >= 0) this.place(this.segments[this.cut].end + by); }

  merge(after = false) {
    const { cut } = this;
    if (cut < 0) return;
    this.select(-1);
    if (this.#do(edits.mergeCut(this.segments, cut, after), { note: 'merged two segments' })) announce(`Merged into ${this.segments[Math.min(cut, this.segments.length - 1)].name}.`);
  }

  split() {
    const { frame } = this.#result.clock;
    if (!this.#do(edits.split(this.segments, frame), { note: 'split a segment' })) return announce('There is a cut here already.');
    announce(`Cut at frame ${shownFrame(frame)}.`);
    this.select(this.here - 1);
  }

  rename(name) {
    const { motion, name: before } = this.segments[this.here];
    const called = name.trim();
    const joins = this.segments.some((segment) => segment.motion !== motion && segment.name === called);
    const note = joins ? `joined ${before} to ${called}` : `renamed ${before} to ${called}`;
    if (this.#do(edits.renameMotion(this.segments, motion, name), { note })) announce(`${sentence(note)}.`);
  }

  /** Make the segment here another motion; null: one of its own. */
  give(motion) { this.#do(edits.giveMotion(this.segments, this.here, motion), { note: 'changed the motion of a segment' }); }

  /** Set or take away `loop` or `discard` of the segment here. */
  flag(name) {
    const on = !this.segments[this.here][name];
    const note = { loop: ['took a loop back', 'marked a loop'], discard: ['took a segment back', 'discarded a segment'] }[name][Number(on)];
    if (this.#do(edits.mark(this.segments, this.here, name, on), { note })) announce(`${sentence(note)}.`);
  }

  undo() { if (this.#history.undo()) this.#restored('undid'); }

  redo() { if (this.#history.redo()) this.#restored('redid'); }

  close() { this.saving.close(); }

  #do(segments, { key = null, note = '', keep = true }) {
    if (!this.#history.push(segments, key)) return false;
    this.#show(keep, note);
    return true;
  }

  #restored(word) {
    if (this.cut >= this.segments.length - 1) this.select(-1);
    this.#show(true, word);
    if (this.cut >= 0) this.#toCut();
    announce(word === 'undid' ? 'Undone.' : 'Redone.');
  }

  #show(keep, note) {
    this.#result.edited(edits.readWith(this.#result.document, this.segments));
    if (keep) this.saving.want(this.segments, note);
    this.#listener();
  }

  #toCut() {
    const frame = this.segments[this.cut].end;
    this.#result.clock.toggle(false);
    this.#result.clock.seek(frame);
    this.#result.span.reveal(frame);
  }

  #tellCut() { if (this.cut >= 0) announce(`Cut at frame ${shownFrame(this.segments[this.cut].end)}.`); }
}

const sentence = (note) => note[0].toUpperCase() + note.slice(1);
