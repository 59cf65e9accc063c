// The moment in words and numbers: where it is, what is moving, and how much.

import { numberOf, shownFrame } from '../frame_numbering.js';
import { $ } from '../dom.js';
import { clock as clockTime } from '../number_format.js';
import { captions } from './pair.js';

/** Say where the clock of a result is, in which `segment`; `pair` are the two around a selected cut, or null. */
export function tellMoment({ clock, document: { energy }, seconds }, segment, pair) {
  const { frame, playing } = clock;
  const field = $('frame');
  if (field !== document.activeElement) field.value = numberOf(frame);
  $('seconds').textContent = clockTime(seconds);
  const nats = energy[frame] ?? null;
  $('nats').textContent = nats === null ? '' : `${nats.toFixed(3)} nats`;
  document.body.classList.toggle('playing', playing);
  $('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
  $('timeline').setAttribute('aria-valuenow', frame);
  $('timeline').setAttribute('aria-valuetext', `frame ${shownFrame(frame)}, motion ${segment.name}`);
  captions(pair);
}
