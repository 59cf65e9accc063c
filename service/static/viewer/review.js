// The cuts, least certain first, for a person to look through. What was checked is remembered in this browser.

import { onCounting, shownFrame } from './counting.js';
import { $, inView, make, unseen } from './dom.js';
import { stored, store } from './memory.js';
import { count } from './numbers.js';
import { swatch } from './palette.js';
import { roving, stop } from './roving.js';

const DOUBT = 0.5; // less certain than this, a cut is doubtful
const AROUND = 0.5; // seconds played on either side
const WIDE = 30; // seconds to look at a cut in, where more than twice that is shown

export class Review {
  #list = $('cuts'); #editor; #clock; #span; #key; #checked; #rows = new Map(); #drawn = null;

  /** `editor` selects cuts, `clock` plays around them, `span` shows them; results are told apart by `id`. */
  constructor(id, editor, clock, span, signal) {
    this.#editor = editor;
    this.#clock = clock;
    this.#span = span;
    this.#key = `caesura.checked.${id}`;
    this.#checked = new Set(stored(this.#key, []));
    this.#list.replaceChildren();
    onCounting(() => { this.#drawn = null; this.show(); }, signal);
  }

  /** Cuts that nobody has checked or placed, least certain first. */
  get #open() { return this.#order().filter(({ segment }) => this.#unchecked(segment)); }

  /** List the cuts as they are now, and mark the selected one. */
  show() {
    const { segments } = this.#editor;
    if (this.#drawn !== segments) this.#draw(segments);
    const chosen = this.#rowOf(this.#editor.cut);
    const marked = this.#list.querySelector('[aria-current]');
    if (marked !== chosen) marked?.removeAttribute('aria-current');
    chosen?.setAttribute('aria-current', 'true');
    for (const id of ['around', 'checked']) $(id).disabled = this.#editor.cut < 0;
    const at = segments[this.#editor.cut];
    $('checked').setAttribute('aria-pressed', String(Boolean(at && this.#checked.has(at.end))));
  }

  /** Select the cut that is least certain after the selected one, and bring its row into view. Answers whether there was one. */
  next() {
    const open = this.#open;
    const at = open.findIndex(({ cut }) => cut === this.#editor.cut);
    const next = open[(at + 1) % Math.max(1, open.length)];
    if (!next) return false;
    this.#choose(next.cut);
    inView(this.#list, this.#rowOf(next.cut));
    return true;
  }

  /** Mark the selected cut as checked and go on, or take the mark away. */
  check() {
    const segment = this.#editor.segments[this.#editor.cut];
    if (!segment) return;
    const before = this.#checked.has(segment.end);
    if (before) this.#checked.delete(segment.end); else this.#checked.add(segment.end);
    store(this.#key, [...this.#checked]);
    this.#drawn = null;
    if (before || !this.next()) this.show();
  }

  /** Play a second around the selected cut. */
  play() {
    const segment = this.#editor.segments[this.#editor.cut];
    if (!segment) return;
    const some = AROUND * this.#clock.rate;
    this.#clock.once(segment.end - some, segment.end + some, segment.end);
  }

  /** Select a cut, near enough to see where it lies. */
  #choose(cut) {
    this.#editor.select(cut);
    const { end } = this.#editor.segments[cut];
    const wide = WIDE * this.#clock.rate;
    if (this.#span.length > 2 * wide) this.#span.set(end - wide / 2, end + wide / 2);
  }

  #unchecked({ end, confidence }) { return confidence !== null && !this.#checked.has(end); }

  #doubtful(segment) { return this.#unchecked(segment) && segment.confidence < DOUBT; }

  /** All cuts: those without an open question last. */
  #order() {
    const cuts = this.#editor.segments.slice(0, -1).map((segment, cut) => ({ segment, cut }));
    const rank = ({ segment }) => (segment.confidence === null || this.#checked.has(segment.end) ? 2 : segment.confidence);
    return cuts.sort((one, other) => rank(one) - rank(other) || one.cut - other.cut);
  }

  /** Bring the list to what the cuts are now, row by row: an edit changes a few of what may be hundreds. */
  #draw(segments) {
    this.#drawn = segments;
    const order = this.#order();
    const kept = new Map();
    order.forEach(({ cut }, place) => {
      const text = this.#text(segments, cut);
      const row = this.#rows.get(text.key) || this.#row(segments, cut, text);
      kept.set(text.key, row);
      if (this.#list.children[place] !== row.parentElement) this.#list.insertBefore(row.parentElement, this.#list.children[place] || null);
    });
    while (this.#list.children.length > order.length) this.#list.lastChild.remove();
    this.#rows = kept;
    if (!this.#list.querySelector('[tabindex="0"]')) stop(this.#list, 'button');
    this.#say(order);
  }

  #say(order) {
    const open = order.filter(({ segment }) => this.#unchecked(segment));
    const doubtful = open.filter(({ segment }) => this.#doubtful(segment)).length;
    $('doubts').textContent = doubtful;
    $('doubts').hidden = !doubtful;
    $('doubtful').disabled = !open.length;
    $('review-hint').textContent = !order.length ? 'There are no cuts: the take is one segment.'
      : open.length ? `${doubtful ? count(doubtful, 'cut is', 'cuts are') : 'No cut is'} in doubt. Least certain first.` : 'Every cut has been checked.';
  }

  /** What a row says, and a key that is another whenever the row must be. */
  #text(segments, cut) {
    const [before, after] = [segments[cut], segments[cut + 1]];
    const known = this.#checked.has(before.end) ? 'checked' : before.confidence === null ? 'set by hand' : null;
    const state = known || `${Math.round(100 * before.confidence)} %`;
    const frame = shownFrame(before.end);
    return { frame, state, known, key: [frame, state, before.motion, before.name, after.motion, after.name].join('\n') };
  }

  #row(segments, cut, { frame, state, known }) {
    const [before, after] = [segments[cut], segments[cut + 1]];
    const at = () => this.#editor.segments.findIndex((segment) => segment.end === before.end);
    const row = make('button', { type: 'button', className: 'cut', tabIndex: -1, onclick: () => this.#choose(at()) },
      swatch(before.motion), swatch(after.motion),
      make('span', { className: 'name' }, `${before.name} | ${after.name}`),
      unseen(' at frame '),
      make('span', { className: 'from' }, frame),
      unseen(known ? ' ' : ' certain to '),
      make('span', { className: 'sure' }, state));
    row.classList.toggle('open', this.#doubtful(before));
    make('li', {}, row);
    return row;
  }

  /** The row of a cut, if it is listed. */
  #rowOf(cut) { return cut < 0 ? null : this.#rows.get(this.#text(this.#editor.segments, cut).key); }
}

/** Wire the tools of the list once. */
export function reviewTools(review) {
  roving($('cuts'), 'button');
  $('doubtful').addEventListener('click', () => review()?.next());
  $('around').addEventListener('click', () => review()?.play());
  $('checked').addEventListener('click', () => review()?.check());
}
