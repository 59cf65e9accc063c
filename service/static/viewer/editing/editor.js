// The editor of a result: the selected cut, the edits, undo, and saving. Every edit goes through `#apply`.

import { frameText } from '../number_format.js';
import { announce } from '../dom.js';
import { UndoHistory } from './undo_history.js';
import { RevisionSaving } from './revision_saving.js';
import * as edits from './segment_edits.js';

export class Editor {
  #history; #result; #listener; #drag = 0;

  /** `newest` is the number of the newest revision. `onChange()` is called after an edit, a selection, and when saving changes. */
  constructor(result, { newest, onChange }) {
    const { id, revision = 0, segments } = result.document;
    this.cut = -1;
    this.#result = result;
    this.#listener = onChange;
    this.#history = new UndoHistory(segments);
    this.saving = new RevisionSaving({ id, segments, shown: revision, newest, onState: onChange });
  }

  get segments() { return this.#history.present; }

  get canUndo() { return this.#history.canUndo; }

  get canRedo() { return this.#history.canRedo; }

  /** The index of the segment that the playhead is in. */
  get currentIndex() { return edits.segmentIndexAt(this.segments, this.#result.playhead.frame); }

  /** Select a cut (-1: none), and move the playhead to it. */
  select(cut) {
    const chosen = cut >= 0 && cut < this.segments.length - 1 ? cut : -1;
    if (chosen === this.cut) return;
    this.#history.endStep();
    this.cut = chosen;
    if (chosen >= 0) this.#goToCut();
    this.#result.selected(chosen);
    this.#listener();
  }

  /** Select the cut before or after the playhead, or before or after the selected cut. */
  selectNext(by) {
    const from = this.cut >= 0 ? this.cut + by : this.currentIndex - (by < 0 ? 1 : 0);
    this.select(Math.max(0, Math.min(this.segments.length - 2, from)));
  }

  /** Begin to drag a cut: all steps of the drag are one edit. */
  beginDrag(cut) {
    this.#drag += 1;
    this.select(cut);
  }

  /** Move the dragged cut; the page shows it at once, `endDrag` saves it. */
  dragTo(frame) { this.#apply(edits.moveCut(this.segments, this.cut, frame), { key: `drag ${this.#drag}`, keep: false }); this.#goToCut(); }

  endDrag() {
    this.#history.endStep();
    this.saving.schedule(this.segments, 'moved a cut');
    this.#announceCut();
  }

  /** Move the selected cut to a frame. */
  moveTo(frame) {
    if (this.cut < 0) return;
    this.#apply(edits.moveCut(this.segments, this.cut, frame), { key: `nudge ${this.cut}`, note: 'moved a cut' });
    this.#goToCut();
    this.#announceCut();
  }

  nudge(by) { if (this.cut >= 0) this.moveTo(this.segments[this.cut].end + by); }

  merge(after = false) {
    const { cut } = this;
    if (cut < 0) return;
    this.select(-1);
    if (this.#apply(edits.mergeCut(this.segments, cut, after), { note: 'merged two segments' })) announce(`Merged into ${this.segments[Math.min(cut, this.segments.length - 1)].name}.`);
  }

  split() {
    const { frame } = this.#result.playhead;
    if (!this.#apply(edits.split(this.segments, frame), { note: 'split a segment' })) return announce('There is a cut here already.');
    announce(`Cut at frame ${frameText(frame)}.`);
    this.select(this.currentIndex - 1);
  }

  rename(name) {
    const { motion, name: before } = this.segments[this.currentIndex];
    const called = name.trim();
    const joins = this.segments.some((segment) => segment.motion !== motion && segment.name === called);
    const note = joins ? `joined ${before} to ${called}` : `renamed ${before} to ${called}`;
    if (this.#apply(edits.renameMotion(this.segments, motion, name), { note })) announce(`${sentence(note)}.`);
  }

  /** Give the current segment another motion; null: a new one. */
  assignMotion(motion) { this.#apply(edits.assignMotion(this.segments, this.currentIndex, motion), { note: 'changed the motion of a segment' }); }

  /** Set or clear `loop` or `discard` of the current segment. */
  toggleFlag(name) {
    const on = !this.segments[this.currentIndex][name];
    const note = { loop: ['took a loop back', 'marked a loop'], discard: ['took a segment back', 'discarded a segment'] }[name][Number(on)];
    if (this.#apply(edits.setFlag(this.segments, this.currentIndex, name, on), { note })) announce(`${sentence(note)}.`);
  }

  undo() { if (this.#history.undo()) this.#showRestored('undid'); }

  redo() { if (this.#history.redo()) this.#showRestored('redid'); }

  close() { this.saving.close(); }

  #apply(segments, { key = null, note = '', keep = true }) {
    if (!this.#history.push(segments, key)) return false;
    this.#show(keep, note);
    return true;
  }

  #showRestored(word) {
    if (this.cut >= this.segments.length - 1) this.select(-1);
    this.#show(true, word);
    if (this.cut >= 0) this.#goToCut();
    announce(word === 'undid' ? 'Undone.' : 'Redone.');
  }

  #show(keep, note) {
    this.#result.edited(edits.withSegments(this.#result.document, this.segments));
    if (keep) this.saving.schedule(this.segments, note);
    this.#listener();
  }

  #goToCut() {
    const frame = this.segments[this.cut].end;
    this.#result.playhead.toggle(false);
    this.#result.playhead.seek(frame);
    this.#result.range.reveal(frame);
  }

  #announceCut() { if (this.cut >= 0) announce(`Cut at frame ${frameText(this.segments[this.cut].end)}.`); }
}

const sentence = (note) => note[0].toUpperCase() + note.slice(1);
