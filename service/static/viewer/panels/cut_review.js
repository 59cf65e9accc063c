// The review: all cuts, the least certain first; a person plays around each and marks it as checked.

import { isDoubtful } from '../editing/segment_edits.js';
import { $, scrollToRow, make, screenReaderText } from '../dom.js';
import { count, onFrameNumbering, frameText } from '../number_format.js';
import { store, stored } from '../local_storage.js';
import { motionSwatch } from '../palette.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';

const AROUND = 0.5; // seconds played on either side
const WIDE = 30; // seconds to look at a cut in, where more than twice that is shown

export class CutReview {
  #list = $('cuts'); #editor; #playhead; #range; #checked; #rows = new Map(); #drawn = null;

  /** `editor` selects cuts, `playhead` plays around them, `range` shows them; `id` is that of the result. */
  constructor(id, editor, playhead, range, signal) {
    this.#editor = editor;
    this.#playhead = playhead;
    this.#range = range;
    this.#checked = new CheckedCuts(id);
    this.#list.replaceChildren();
    onFrameNumbering(() => { this.#drawn = null; this.show(); }, signal);
  }

  /** List the cuts as they are now, and mark the selected one. */
  show() {
    const { segments } = this.#editor;
    if (this.#drawn !== segments) this.#draw(segments);
    const chosen = this.#rowOf(this.#editor.cut);
    const marked = this.#list.querySelector('[aria-current]');
    if (marked !== chosen) marked?.removeAttribute('aria-current');
    chosen?.setAttribute('aria-current', 'true');
    const at = this.#selected;
    for (const id of ['around', 'checked']) $(id).disabled = !at;
    $('checked').setAttribute('aria-pressed', String(Boolean(at && this.#checked.has(at.end))));
  }

  /** Select the cut that is least certain after the selected one, and bring its row into view. Answers whether there was one. */
  next() {
    const open = this.#order().filter(({ segment }) => this.#isOpen(segment));
    const at = open.findIndex(({ cut }) => cut === this.#editor.cut);
    const next = open[(at + 1) % Math.max(1, open.length)];
    if (!next) return false;
    this.#choose(next.cut);
    scrollToRow(this.#list, this.#rowOf(next.cut));
    return true;
  }

  /** Mark the selected cut as checked and go on, or take the mark away. */
  check() {
    if (!this.#selected) return;
    const marked = this.#checked.toggle(this.#selected.end);
    this.#drawn = null;
    if (!marked || !this.next()) this.show();
  }

  /** Play a second around the selected cut. */
  play() {
    if (!this.#selected) return;
    const { end } = this.#selected;
    const some = AROUND * this.#playhead.rate;
    this.#playhead.playOnce(end - some, end + some, end);
  }

  /** The segment that the selected cut ends, if one is selected. */
  get #selected() { return this.#editor.segments[this.#editor.cut]; }

  /** Select a cut, near enough to see where it lies. */
  #choose(cut) {
    this.#editor.select(cut);
    const { end } = this.#editor.segments[cut];
    const wide = WIDE * this.#playhead.rate;
    if (this.#range.length > 2 * wide) this.#range.set(end - wide / 2, end + wide / 2);
  }

  /** Whether no person has checked or placed the cut that ends a segment. */
  #isOpen({ end, confidence }) { return confidence !== null && !this.#checked.has(end); }

  /** All cuts, those that a person has checked or placed last. */
  #order() {
    const cuts = this.#editor.segments.slice(0, -1).map((segment, cut) => ({ segment, cut }));
    const rank = ({ segment }) => (this.#isOpen(segment) ? segment.confidence : 2);
    return cuts.sort((one, other) => rank(one) - rank(other) || one.cut - other.cut);
  }

  /** Bring the list to what the cuts are now, row by row: an edit changes a few of what may be hundreds. */
  #draw(segments) {
    this.#drawn = segments;
    const order = this.#order();
    const kept = new Map();
    order.forEach(({ segment, cut }, place) => {
      const text = this.#text(cut);
      const item = this.#rows.get(text.key) || this.#item(segment, segments[cut + 1], text);
      kept.set(text.key, item);
      if (this.#list.children[place] !== item) this.#list.insertBefore(item, this.#list.children[place] || null);
    });
    while (this.#list.children.length > order.length) this.#list.lastChild.remove();
    this.#rows = kept;
    if (!this.#list.querySelector('[tabindex="0"]')) setTabStop(this.#list, 'button');
    this.#say(order.map(({ segment }) => segment));
  }

  #say(segments) {
    const open = segments.filter((segment) => this.#isOpen(segment));
    const doubts = open.filter(isDoubtful).length;
    $('doubts').textContent = doubts;
    $('doubts').hidden = !doubts;
    $('doubtful').disabled = !open.length;
    $('review-hint').textContent = !segments.length ? 'There are no cuts: the take is one segment.'
      : open.length ? `The method doubts ${doubts ? count(doubts, 'cut') : 'no cut'}. The least certain come first.` : 'You have checked every cut.';
  }

  #text(cut) {
    const [before, after] = this.#editor.segments.slice(cut, cut + 2);
    return cutText(before, after, this.#checked.has(before.end));
  }

  #item(before, after, text) {
    const choose = () => this.#choose(this.#editor.segments.findIndex((segment) => segment.end === before.end));
    return make('li', {}, cutRow(before, after, text, choose));
  }

  /** The row of a cut, if it is listed. */
  #rowOf(cut) { return cut < 0 ? null : this.#rows.get(this.#text(cut).key)?.firstChild; }
}

/** Wire the tools of the list once. */
export function addReviewTools(review) {
  addRovingFocus($('cuts'), 'button');
  $('doubtful').addEventListener('click', () => review()?.next());
  $('around').addEventListener('click', () => review()?.play());
  $('checked').addEventListener('click', () => review()?.check());
}

/** The texts of the row of a cut between two segments, and a key that changes whenever the row must. */
function cutText(before, after, checked) {
  const known = checked ? 'checked' : before.confidence === null ? 'set by hand' : null;
  const state = known || `${Math.round(100 * before.confidence)} %`;
  const frame = frameText(before.end);
  return { frame, state, known, key: [frame, state, before.motion, before.name, after.motion, after.name].join('\n') };
}

/** The row, a button that calls `choose`. */
function cutRow(before, after, { frame, state, known }, choose) {
  const names = `${before.name} | ${after.name}`;
  const row = make('button', { type: 'button', className: 'cut', tabIndex: -1, onclick: choose },
    motionSwatch(before.motion), motionSwatch(after.motion),
    make('span', { className: 'name', title: names }, names),
    screenReaderText(' at frame '),
    make('span', { className: 'from' }, frame),
    screenReaderText(known ? ' ' : ' certain to '),
    make('span', { className: 'sure' }, state));
  row.classList.toggle('open', !known && isDoubtful(before));
  return row;
}

class CheckedCuts {
  #key; #frames;

  /** The checked cuts of the result `id`, remembered in this browser. A cut is known by its frame. */
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
