// The editor of a result: the selected cut, the edits, undo, and saving. Every edit goes through `#apply`.

import { frameText } from '../number_format.js';
import { announce } from '../dom.js';
import { UndoHistory } from './undo_history.js';
import { RevisionSaving } from './revision_saving.js';
import * as edits from './segment_edits.js';

const SHORTEST = 0.1; // seconds of the shortest segment that a drag leaves

export class Editor {
  #fixed; #history; #result; #listener; #drag = 0;

  /**
   * `newest` is the number of the newest revision. `onChange()` is called after an edit, a selection, and when saving changes.
   * `fixed`: nothing can be edited.
   */
  constructor(result, { newest, fixed = false, onChange }) {
    this.#fixed = fixed;
    const { id, revision = 0, segments } = result.document;
    this.cut = -1;
    this.chosen = new Set(); // indices of segments that edits are for; none: the one that the playhead is in
    this.#result = result;
    this.#listener = onChange;
    this.#history = new UndoHistory(segments);
    this.saving = new RevisionSaving({ id, segments, shown: revision, newest, onState: onChange, onSaved: (saved) => this.#adopt(saved) });
  }

  get segments() { return this.#history.present; }

  get canUndo() { return this.#history.canUndo; }

  get canRedo() { return this.#history.canRedo; }

  /** The index of the segment that the playhead is in. */
  get currentIndex() { return edits.segmentIndexAt(this.segments, this.#result.playhead.frame); }

  /** The indices of the segments that edits are for. */
  get affected() { return this.chosen.size ? [...this.chosen].sort((a, b) => a - b) : [this.currentIndex]; }

  /** Choose these segments and no other; the playhead goes to the first, if it is in none of them. */
  chooseOnly(indices) {
    this.#setChosen(new Set(indices));
    if (indices.length && !this.chosen.has(this.currentIndex)) this.#result.playhead.seek(this.segments[indices[0]].start);
  }

  /** Choose a segment besides, or no longer. */
  toggleChosen(index) {
    const chosen = new Set(this.chosen);
    if (!chosen.delete(index)) chosen.add(index);
    this.#setChosen(chosen);
  }

  /** Choose all segments from the one that the playhead is in to this one. */
  chooseTo(index) {
    const [first, last] = [this.currentIndex, index].sort((a, b) => a - b);
    this.#setChosen(new Set(Array.from({ length: last - first + 1 }, (_, i) => first + i)));
  }

  #setChosen(chosen) {
    if (!chosen.size && !this.chosen.size) return;
    this.select(-1);
    this.chosen = chosen;
    this.#result.chosen(chosen);
    this.#listener();
  }

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

  /** Begin to drag the selected cut: all steps of the drag are one edit. */
  beginDrag() {
    this.#drag += 1;
    this.#history.endStep();
  }

  /** Move the dragged cut; the page shows it at once, `endDrag` saves it. It leaves no segment too short to be meant. */
  dragTo(frame) {
    const least = Math.ceil(SHORTEST * this.#result.document.frame_rate);
    this.#apply(edits.moveCut(this.segments, this.cut, frame, least), { key: `drag ${this.#drag}`, keep: false });
    this.#goToCut();
  }

  /** Put the dragged cut back. */
  cancelDrag() {
    if (this.#history.drop(`drag ${this.#drag}`)) this.#show(false);
    this.#goToCut();
    announce('The cut is where it was.');
  }

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

  /** Call the motion of the segment otherwise; of several that are chosen, make them one motion of this name. */
  rename(name) {
    if (this.chosen.size) return this.#nameChosen(name.trim());
    const { motion, name: before } = this.segments[this.currentIndex];
    const called = name.trim();
    const joins = this.segments.some((segment) => segment.motion !== motion && segment.name === called);
    const note = joins ? `joined ${before} to ${called}` : `renamed ${before} to ${called}`;
    if (this.#apply(edits.renameMotion(this.segments, motion, name), { note })) announce(`${sentence(note)}.`);
  }

  #nameChosen(name) {
    const count = this.chosen.size;
    const note = `called ${count} segments ${name}`;
    if (this.#apply(edits.nameSegments(this.segments, this.affected, name), { note })) announce(`${sentence(note)}.`);
  }

  /** Give the affected segments another motion; null: a new one. */
  assignMotion(motion) { this.#apply(edits.assignMotion(this.segments, this.affected, motion), { note: 'changed the motion of a segment' }); }

  /** Set `loop` or `discard` of the affected segments; clear it if all have it. */
  toggleFlag(name) {
    const indices = this.affected;
    const on = !indices.every((index) => this.segments[index][name]);
    const note = { loop: ['took a loop back', 'marked a loop'], discard: ['took a segment back', 'discarded a segment'] }[name][Number(on)];
    if (this.#apply(edits.setFlag(this.segments, indices, name, on), { note })) announce(`${sentence(note)}.`);
  }

  undo() { if (this.#history.undo()) this.#showRestored('undid'); }

  redo() { if (this.#history.redo()) this.#showRestored('redid'); }

  close() { this.saving.close(); }

  /** Take over what the service found out about the segments that it `saved`. */
  #adopt(saved) {
    this.#history.amend(edits.withRepeats(this.segments, saved));
    this.#result.edited(edits.withSegments(this.#result.document, this.segments));
  }

  #apply(segments, { key = null, note = '', keep = true }) {
    if (this.#fixed) {
      announce('This link is to look at: nothing can be changed here.');
      return false;
    }
    const count = this.segments.length;
    if (!this.#history.push(segments, key)) return false;
    if (segments.length !== count) this.#setChosen(new Set()); // they are counted anew
    this.#show(keep, note);
    return true;
  }

  #showRestored(word) {
    this.#setChosen(new Set());
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
