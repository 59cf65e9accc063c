// The list of segments: motion, start and length. Every row is a button that goes to the segment; Tab stops at the list once.

import { isDoubtful } from '../editing/segment_edits.js';
import { firstFrameNumber, duration, frameText, intervalText } from '../number_format.js';
import { $, scrollToRow, make, screenReaderText } from '../dom.js';
import { motionSwatch } from '../palette.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';

export class SegmentList {
  #list = $('segments'); #rows = []; #document = null; #counted = 0; #go; #current = null;

  /** `go(index)` is called when a row is chosen. */
  constructor(go) { this.#go = go; }

  /** Show a document. Rows whose segment is the same object stay as they are: an edit changes one or two. */
  show(document) {
    const before = this.#document?.segments || [];
    const whole = before.length !== document.segments.length || this.#counted !== firstFrameNumber();
    this.#document = document;
    this.#counted = firstFrameNumber();
    $('column-frames').textContent = this.#counted ? 'frames' : 'start';
    if (whole) return this.#fill();
    document.segments.forEach((segment, index) => {
      if (segment === before[index]) return;
      const row = this.#row(index);
      row.tabIndex = this.#rows[index].tabIndex;
      if (this.#rows[index] === window.document.activeElement) queueMicrotask(() => row.focus());
      this.#rows[index].replaceWith(row);
      if (this.#rows[index] === this.#current) this.#current = null;
      this.#rows[index] = row;
    });
  }

  /** Mark the row that plays, and keep it in view. */
  mark(index) {
    const row = this.#rows[index];
    if (row === this.#current) return;
    this.#current?.removeAttribute('aria-current');
    this.#current = row;
    if (!row) return;
    row.setAttribute('aria-current', 'true');
    scrollToRow(this.#list, row);
  }

  #fill() {
    this.#rows = this.#document.segments.map((_, index) => this.#row(index));
    this.#current = null;
    this.#list.replaceChildren(...this.#rows.map((row) => make('li', {}, row)));
    setTabStop(this.#list, 'button');
  }

  #row(index) {
    const segment = this.#document.segments[index];
    const length = duration((segment.end - segment.start) / this.#document.frame_rate);
    const place = this.#counted ? intervalText(segment.start, segment.end) : frameText(segment.start);
    const row = make('button', { type: 'button', className: 'segment', tabIndex: -1, onclick: () => this.#go(index) },
      motionSwatch(segment.motion),
      make('span', { className: 'name', title: segment.name }, segment.name),
      screenReaderText(this.#counted ? ' frames ' : ' from frame '),
      make('span', { className: 'from' }, place),
      screenReaderText(' lasts '),
      make('span', { className: 'long' }, length),
      make('span', { className: 'marks' }, segment.loop ? make('span', {}, '↻', screenReaderText(' loops')) : null,
        isDoubtful(segment) ? make('b', { title: 'The method doubts where this segment ends' }, '?', screenReaderText(' doubtful end')) : null));
    if (segment.discard) row.append(screenReaderText(' discarded'));
    row.classList.toggle('discarded', Boolean(segment.discard));
    return row;
  }
}

/** Wire the list once. */
export const addSegmentList = () => addRovingFocus($('segments'), 'button');
