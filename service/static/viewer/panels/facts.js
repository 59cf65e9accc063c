// What is said of a result as a whole, and does not move with the clock: counts, and things to know.

import { $, make } from '../dom.js';
import { count, whole } from '../number_format.js';

/** Say how long a take is, and what the method warns of. */
export function tellTake({ frames, warnings }) {
  $('frames').textContent = whole(frames);
  $('frame').size = $('cut-frame').size = Math.max(3, String(frames).length);
  $('timeline').setAttribute('aria-valuemax', frames - 1);
  $('warnings').hidden = !warnings.length;
  $('warnings').querySelector('summary').textContent = count(warnings.length, 'thing to know', 'things to know');
  $('warnings').querySelector('ul').replaceChildren(...warnings.map((warning) => make('li', {}, warning.detail)));
}

/** Say how many motions and segments there are. */
export function tellCounts({ motions, segments }) {
  $('summary').textContent = `${count(motions, 'motion')} · ${count(segments.length, 'segment')}`;
}
