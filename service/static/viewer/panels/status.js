// What the page says of a result in words and numbers: counts and warnings of the take, the moment, the two poses of a cut.

import { $, make } from '../dom.js';
import { clock as clockTime, count, numberOf, shownFrame, whole } from '../number_format.js';
import { tagged } from '../palette.js';

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

/** Say what the two halves of the stage show, of the segments before and after a cut; without them, one pose fills it. */
export function captions(pair) {
  const box = $('pair');
  box.hidden = !pair;
  if (!pair) return;
  const [before, after] = pair;
  const [left, right] = box.children;
  tagged(left.children[0], before);
  tagged(right.children[0], after);
  left.children[1].textContent = `ends with ${shownFrame(before.end - 1)}`;
  right.children[1].textContent = `begins with ${shownFrame(after.start)}`;
}
