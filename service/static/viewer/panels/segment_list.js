// The list of segments, by motion or in the order of time. A row goes to its segment; Tab stops at the list once. Several segments
// are chosen with their boxes, with Ctrl or with Shift, and all of a motion with its row.

import { firstFrameNumber } from '../number_format.js';
import { $, scrollToRow } from '../dom.js';
import { store, stored } from '../local_storage.js';
import { portraitFrame } from '../editing/segment_edits.js';
import { portraitCanvas } from '../figure/thumbnails.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';
import { motionLength, motionRow, segmentRow } from './segment_row.js';

const KEY = 'caesura.list-by';
const MANY = 60; // segments from which on motions are folded until a person opens them, and only motions have pictures

export class SegmentList {
  #list = $('segments'); #rows = []; #document = null; #counted = 0; #result; #current = null; #folded = new Map(); #heads = new Map(); #by = stored(KEY, 'motion');

  constructor(result) { this.#result = result; }

  /** Show a document. Rows whose segment is the same object stay as they are: an edit changes one or two. */
  show(document) {
    const before = this.#document?.segments || [];
    const moved = document.segments.some(({ motion, name }, index) => motion !== before[index]?.motion || name !== before[index].name);
    const whole = before.length !== document.segments.length || this.#counted !== firstFrameNumber() || moved;
    this.#document = document;
    this.#counted = firstFrameNumber();
    if (whole) return this.#fill();
    const changed = new Set();
    document.segments.forEach((segment, index) => {
      if (segment === before[index]) return;
      this.#replace(index);
      changed.add(segment.motion);
    });
    if (this.#by === 'motion') for (const motion of changed) this.#updateHead(motion);
    this.choose(this.#result.editor?.chosen ?? new Set());
  }

  /** List by `motion`, or in the order of `time`. */
  arrange(by) {
    this.#by = by;
    store(KEY, by);
    this.#fill();
  }

  /** Mark the row that plays, and keep it in view. */
  mark(index) {
    const row = this.#rows[index]?.button;
    if (row === this.#current) return;
    this.#current?.removeAttribute('aria-current');
    this.#current = row;
    if (!row) return;
    row.setAttribute('aria-current', 'true');
    if (row.offsetParent) scrollToRow(this.#list, row);
  }

  /** Mark the rows that are chosen. */
  choose(indices) {
    this.#rows.forEach(({ box, item }, index) => {
      box.checked = indices.has(index);
      item.classList.toggle('chosen', indices.has(index));
    });
    this.#list.classList.toggle('choosing', indices.size > 0);
  }

  /** The index of the segment whose row has the focus, or -1. */
  get focused() { return this.#rows.findIndex(({ button }) => button === document.activeElement); }

  #fill() {
    const { focused } = this;
    for (const radio of document.querySelectorAll('[name=list-by]')) radio.checked = radio.value === this.#by;
    $('column-frames').textContent = this.#counted ? 'frames' : 'start';
    this.#rows = this.#document.segments.map((_, index) => this.#row(index));
    this.#current = null;
    this.#list.replaceChildren(...(this.#by === 'time' ? this.#rows.map(({ item }) => item) : this.#groups()));
    setTabStop(this.#list, 'button', this.#rows[focused]?.button);
    if (focused >= 0) this.#rows[focused]?.button.focus();
    if (this.#result.editor) this.choose(this.#result.editor.chosen);
    this.mark(this.#result.segmentIndexAt(this.#result.playhead.frame));
  }

  /** A row for each motion, with its segments below it. */
  #groups() {
    const { segments } = this.#document;
    const motions = Map.groupBy(segments.keys(), (index) => segments[index].motion);
    return [...motions].flatMap(([motion, indices]) => {
      const open = !(this.#folded.get(motion) ?? segments.length > MANY);
      for (const index of indices) this.#rows[index].item.hidden = !open;
      const first = segments[indices[0]];
      const head = motionRow(this.#document, indices.map((index) => segments[index]), {
        open,
        choose: () => this.#result.editor.chooseOnly(indices),
        fold: ({ currentTarget }) => {
          const folded = currentTarget.getAttribute('aria-expanded') === 'true';
          this.#folded.set(motion, folded);
          currentTarget.setAttribute('aria-expanded', String(!folded));
          for (const index of indices) this.#rows[index].item.hidden = folded;
        },
        picture: this.#picture(first),
      });
      this.#heads.set(motion, head);
      return [head, ...indices.map((index) => this.#rows[index].item)];
    });
  }

  /** The picture of a segment. */
  #picture(segment) { return portraitCanvas(this.#result.thumbnails, portraitFrame(segment)); }

  /** How long a motion is altogether. */
  #updateHead(motion) {
    const segments = this.#document.segments.filter((segment) => segment.motion === motion);
    this.#heads.get(motion).querySelector('.long').textContent = motionLength(this.#document, segments);
  }

  #replace(index) {
    const row = this.#row(index);
    const old = this.#rows[index];
    row.item.hidden = old.item.hidden;
    row.button.tabIndex = old.button.tabIndex;
    if (old.button === document.activeElement) queueMicrotask(() => row.button.focus());
    old.item.replaceWith(row.item);
    if (old.button === this.#current) this.#current = null;
    this.#rows[index] = row;
  }

  #row(index) {
    const { segments } = this.#document;
    return segmentRow(this.#document, segments[index], {
      picture: segments.length > MANY ? null : this.#picture(segments[index]),
      go: (event) => this.#press(index, event),
      choose: () => this.#result.editor.toggleChosen(index),
    });
  }

  #press(index, { shiftKey, ctrlKey, metaKey }) {
    const { editor } = this.#result;
    if (shiftKey) return editor.chooseTo(index);
    if (ctrlKey || metaKey) return editor.toggleChosen(index);
    this.#result.goToSegment(index);
  }
}

/** Wire the list once. `shown()` is the result on screen. */
export function addSegmentList(shown) {
  addRovingFocus($('segments'), 'button:not([hidden] *)');
  $('segments').addEventListener('keydown', ({ key, shiftKey }) => { if (shiftKey && key.startsWith('Arrow')) shown()?.chooseToFocus(); });
  for (const radio of document.querySelectorAll('[name=list-by]')) radio.addEventListener('change', () => shown()?.arrangeList(radio.value));
}
