// The review: all cuts and the frames at which one may be missing, the least certain first; a person plays around each, and
// marks it as checked.

import { isDoubtful, segmentIndexAt } from '../editing/segment_edits.js';
import { $, announce, scrollToRow, make } from '../dom.js';
import { count, onFrameNumbering, frameText } from '../number_format.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';
import { CheckedFrames } from './checked_frames.js';
import { isLikely, reviewRow, reviewText } from './review_row.js';

const AROUND = 0.5; // seconds played on either side
const WIDE = 30; // seconds to look at a cut in, where more than twice that is shown
const NEAR = 0.3; // seconds from a cut: nothing is missing there

export class CutReview {
  #list = $('cuts'); #editor; #playhead; #range; #checked; #candidates; #rows = new Map(); #drawn = null; #candidate = -1;

  /** `editor` selects cuts of `document`, `playhead` plays around them, `range` shows them. */
  constructor(document, editor, playhead, range, signal) {
    this.#editor = editor;
    this.#playhead = playhead;
    this.#range = range;
    this.#candidates = document.candidates ?? [];
    this.#checked = new CheckedFrames(document.id);
    this.#list.replaceChildren();
    onFrameNumbering(() => { this.#drawn = null; this.show(); }, signal);
    const left = playhead.listen(() => this.#leaveCandidate());
    signal.addEventListener('abort', left);
  }

  /** List the cuts as they are now, and mark the selected one. */
  show() {
    const { segments } = this.#editor;
    if (this.#drawn !== segments) this.#draw(segments);
    const at = this.#selected;
    const chosen = at && this.#rows.get(reviewText(at).key)?.firstChild;
    const marked = this.#list.querySelector('[aria-current]');
    if (marked !== chosen) marked?.removeAttribute('aria-current');
    chosen?.setAttribute('aria-current', 'true');
    for (const id of ['around', 'checked']) $(id).disabled = !at;
    $('cut-here').hidden = !at || Boolean(at.after);
    $('checked').setAttribute('aria-pressed', String(Boolean(at?.checked)));
  }

  /** Select what is least certain after the selected one, and bring its row into view. Answers whether there was one. */
  next() {
    const open = this.#order().filter(isOpen);
    const at = open.findIndex(({ frame }) => frame === this.#selected?.frame);
    const next = open[(at + 1) % Math.max(1, open.length)];
    if (!next) return false;
    this.#choose(next);
    scrollToRow(this.#list, this.#rows.get(reviewText(next).key)?.firstChild);
    return true;
  }

  /** Mark the selected one as checked and go on, or take the mark away. */
  check() {
    if (!this.#selected) return;
    const marked = this.#checked.toggle(this.#selected.frame);
    this.#drawn = null;
    if (!marked || !this.next()) this.show();
  }

  /** Cut where a cut is missing. */
  cutHere() { if (this.#selected && !this.#selected.after) this.#editor.split(); }

  /** Play a second around the selected one. */
  play() {
    if (!this.#selected) return;
    const { frame } = this.#selected;
    const some = AROUND * this.#playhead.rate;
    this.#playhead.playOnce(frame - some, frame + some, frame);
  }

  /** The item of the selected cut, or of the candidate that the playhead is at; null where there is neither. */
  get #selected() {
    const { cut } = this.#editor;
    if (cut >= 0) return this.#cutItem(cut);
    return this.#candidate < 0 ? null : this.#open().find(({ frame }) => frame === this.#candidate) ?? null;
  }

  #leaveCandidate() {
    if (this.#candidate < 0 || this.#playhead.playing || this.#playhead.frame === this.#candidate) return;
    this.#candidate = -1;
    this.show();
  }

  /** Select an item, near enough to see where it lies. */
  #choose({ frame, after }) {
    const cut = after ? this.#editor.segments.findIndex(({ end }) => end === frame) : -1;
    this.#candidate = after ? -1 : frame;
    this.#editor.select(cut);
    if (!after) {
      this.#playhead.toggle(false);
      this.#playhead.seek(frame);
    }
    const wide = WIDE * this.#playhead.rate;
    if (this.#range.length > 2 * wide) this.#range.set(frame - wide / 2, frame + wide / 2);
    else if (!after) this.#range.reveal(frame);
    if (after) return;
    announce(`A cut may be missing at frame ${frameText(frame)}.`);
    this.show();
  }

  #cutItem(cut) {
    const [segment, after] = this.#editor.segments.slice(cut, cut + 2);
    return { frame: segment.end, segment, after, checked: this.#checked.has(segment.end) };
  }

  /** The frames at which a cut may be missing, and at which nobody has put one. */
  #open() {
    const { segments } = this.#editor;
    const near = NEAR * this.#playhead.rate;
    return this.#candidates.map(({ frame, likelihood }) => ({ frame, likelihood, segment: segments[segmentIndexAt(segments, frame)], checked: this.#checked.has(frame) }))
      .filter(({ frame, segment: { start, end } }) => frame - start > near && end - frame > near);
  }

  /** Everything, what a person has checked or placed last. */
  #order() {
    const cuts = this.#editor.segments.slice(0, -1).map((_, cut) => this.#cutItem(cut));
    const rank = (item) => (!isOpen(item) ? 2 : item.after ? item.segment.confidence : 1 - item.likelihood);
    return [...cuts, ...this.#open()].sort((one, other) => rank(one) - rank(other) || one.frame - other.frame);
  }

  /** Bring the list to what the cuts are now, row by row: an edit changes a few of what may be hundreds. */
  #draw(segments) {
    this.#drawn = segments;
    const order = this.#order();
    const kept = new Map();
    order.forEach((item, place) => {
      const text = reviewText(item);
      const row = this.#rows.get(text.key) || make('li', {}, reviewRow(item, text, () => this.#choose(item)));
      kept.set(text.key, row);
      if (this.#list.children[place] !== row) this.#list.insertBefore(row, this.#list.children[place] || null);
    });
    while (this.#list.children.length > order.length) this.#list.lastChild.remove();
    this.#rows = kept;
    if (!this.#list.querySelector('[tabindex="0"]')) setTabStop(this.#list, 'button');
    this.#say(order);
  }

  #say(items) {
    const open = items.filter(isOpen);
    const doubts = open.filter((item) => item.after && isDoubtful(item.segment)).length;
    const missing = open.filter((item) => !item.after && isLikely(item)).length;
    $('doubts').textContent = doubts + missing;
    $('doubts').hidden = !(doubts + missing);
    $('doubtful').disabled = !open.length;
    const candidates = missing ? ` ${count(missing, 'cut')} may be missing.` : '';
    $('review-hint').textContent = !items.length ? 'There are no cuts: the take is one segment.'
      : open.length ? `The method doubts ${doubts ? count(doubts, 'cut') : 'no cut'}.${candidates} The least certain come first.` : 'You have checked every cut.';
  }
}

/** Whether no person has checked or placed it. */
const isOpen = ({ checked, after, segment }) => !checked && !(after && segment.confidence === null);

/** Wire the tools of the list once. */
export function addReviewTools(review) {
  addRovingFocus($('cuts'), 'button');
  $('doubtful').addEventListener('click', () => review()?.next());
  $('around').addEventListener('click', () => review()?.play());
  $('checked').addEventListener('click', () => review()?.check());
  $('cut-here').addEventListener('click', () => review()?.cutHere());
}
