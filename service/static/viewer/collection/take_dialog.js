// One take of a collection: its segments in the common motions, to open, to correct and to search by.

import { $, make } from '../dom.js';
import { askForName } from '../name_dialog.js';
import { clockTime, duration } from '../number_format.js';
import { swatchOf } from '../palette.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';
import { segmentStrip } from '../start/segment_strip.js';

const OTHER = ' other'; // no id of a motion begins with a blank

export class TakeDialog {
  #ways; #collection = null; #take = null; #chosen = 0;

  /**
   * Wire the dialog once. `ways.open(take, frame)`, `ways.similar(take, segment)`, `ways.clips(take, note)` and `ways.remove(take)` are
   * called when a person asks; `ways.correct(take, segments)` answers a promise of the take as it is then.
   */
  constructor(ways) {
    this.#ways = ways;
    const dialog = $('take-dialog');
    addRovingFocus($('take-segments'), 'button');
    $('take-close').addEventListener('click', () => dialog.close());
    $('segment-open').addEventListener('click', () => { dialog.close(); ways.open(this.#take, this.#segment.start); });
    $('segment-similar').addEventListener('click', () => { dialog.close(); ways.similar(this.#take, this.#segment); });
    $('segment-motion').addEventListener('change', ({ target: { value } }) => this.#correct(value));
    $('take-clips').addEventListener('click', () => ways.clips(this.#take, (sentence) => this.#note(sentence)));
    $('take-remove').addEventListener('click', () => { dialog.close(); ways.remove(this.#take); });
  }

  show(collection, take) {
    this.#collection = collection;
    this.#chosen = 0;
    this.#note('');
    this.#fill(take);
    if (!$('take-dialog').open) $('take-dialog').showModal();
    $('take-segments').querySelector('button')?.focus();
  }

  get #segment() { return this.#take.segments[this.#chosen]; }

  #note(sentence) { $('take-note').textContent = sentence; }

  #fill(take) {
    this.#take = take;
    $('take-title').textContent = take.name;
    const segments = this.#collection.coloured(take.segments);
    $('take-strip').replaceChildren(segmentStrip(segments, take.frames));
    $('take-segments').replaceChildren(...segments.map((segment, place) => make('li', {}, this.#row(segment, place))));
    this.#choose(Math.min(this.#chosen, segments.length - 1));
  }

  #row({ name, colour, texture, start_seconds: start, end_seconds: end, confidence, corrected }, place) {
    const sure = corrected ? 'yours' : confidence === null ? '' : `${Math.round(100 * confidence)} %`;
    return make('button', { type: 'button', className: 'take-segment', tabIndex: -1, onclick: () => this.#choose(place), onfocus: () => this.#choose(place) },
      swatchOf(colour, texture), make('span', { className: 'name' }, name), make('span', { className: 'from' }, clockTime(start)),
      make('span', { className: 'long' }, duration(end - start)), make('span', { className: 'sure' }, sure));
  }

  #choose(place) {
    this.#chosen = place;
    const rows = [...$('take-segments').querySelectorAll('button')];
    rows.forEach((row, at) => (at === place ? row.setAttribute('aria-current', 'true') : row.removeAttribute('aria-current')));
    setTabStop($('take-segments'), 'button', rows[place]);
    const { motions } = this.#collection.document;
    $('segment-motion').replaceChildren(...motions.map(({ id, name }) => make('option', { value: id }, name)), make('option', { value: OTHER }, 'another motion …'));
    $('segment-motion').value = this.#segment?.motion ?? '';
  }

  /** Say that the chosen segment is of another motion. */
  async #correct(motion) {
    const is = motion === OTHER ? { name: await askForName({ title: 'Another motion', action: 'Set' }) } : { motion };
    $('segment-motion').value = this.#segment.motion;
    if (is.name === null) return;
    const segments = this.#take.segments.map(({ start, end, motion: before }, place) => ({ start, end, ...(place === this.#chosen ? is : { motion: before }) }));
    this.#note('Saving …');
    try {
      this.#fill(await this.#ways.correct(this.#take, segments));
      this.#note('Corrected. What it says of the other takes is worked out, and shown before anything changes.');
    } catch ({ message }) { this.#note(message); }
  }
}
