// What the page says of a result in words and numbers: counts and notes, the current frame, the two poses at a cut.

import { $, make } from '../dom.js';
import { clockTime, count, frameNumber, frameText, grouped } from '../number_format.js';
import { writeTag } from '../palette.js';

/** Show how long a take is, and the warnings of the method. */
export function showTake({ frames, warnings }) {
  $('frames').textContent = grouped(frames);
  $('frame').size = $('cut-frame').size = Math.max(3, String(frames).length);
  $('timeline').setAttribute('aria-valuemax', frames - 1);
  $('warnings').hidden = !warnings.length;
  $('warnings').querySelector('summary').textContent = `${count(warnings.length, 'note')} on this result`;
  $('warnings').querySelector('ul').replaceChildren(...warnings.map((warning) => make('li', {}, warning.detail)));
}

/** Show how many motions and segments there are. */
export function showCounts({ motions, segments }) {
  $('summary').textContent = `${count(motions, 'motion')} · ${count(segments.length, 'segment')}`;
}

/** Show where the playhead of a result is, in which `segment`; `pair` are the two around a selected cut, or null. */
export function showMoment({ playhead, document: { energy }, seconds }, segment, pair) {
  const { frame, playing } = playhead;
  const field = $('frame');
  if (field !== document.activeElement) field.value = frameNumber(frame);
  $('seconds').textContent = clockTime(seconds);
  $('energy').textContent = energy[frame] === null ? '' : `energy ${energy[frame].toFixed(3)}`;
  document.body.classList.toggle('playing', playing);
  $('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
  $('timeline').setAttribute('aria-valuenow', frame);
  $('timeline').setAttribute('aria-valuetext', `frame ${frameText(frame)}, motion ${segment.name}`);
  showPair(pair);
}

/** Name the two poses that the figure panel shows, of the segments before and after a cut; null: there is one pose. */
export function showPair(pair) {
  const box = $('pair');
  box.hidden = !pair;
  if (!pair) return;
  const [before, after] = pair;
  const [left, right] = box.children;
  writeTag(left.children[0], before);
  writeTag(right.children[0], after);
  left.children[1].textContent = `ends with ${frameText(before.end - 1)}`;
  right.children[1].textContent = `begins with ${frameText(after.start)}`;
}
