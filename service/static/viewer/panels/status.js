// What the page says of a result in words and numbers: counts and notes, the current frame, the two poses at a cut.

import { $, make } from '../dom.js';
import { clockTime, count, frameNumber, frameText, grouped } from '../number_format.js';
import { writeTag } from '../palette.js';

/** Show how long a take is, and the warnings of the method; a take without a curve says why in its place. */
export function showTake({ frames, warnings, energy }) {
  $('frames').textContent = grouped(frames);
  $('frame').size = $('cut-frame').size = Math.max(3, String(frames).length);
  $('timeline').setAttribute('aria-valuemax', frames - 1);
  const flat = energy.every((value) => value === null);
  const why = flat && warnings.find(({ code }) => code === 'shorter-than-windows');
  document.body.classList.toggle('no-curve', flat);
  $('no-curve').textContent = flat ? (why?.detail ?? 'This take has no energy curve.') : '';
  const others = warnings.filter((warning) => warning !== why);
  $('warnings').hidden = !others.length;
  $('warnings').replaceChildren(...others.map((warning) => make('li', {}, warning.detail)));
}

/** Show how many motions and segments there are. */
export function showCounts({ motions, segments }) {
  $('summary').textContent = `${count(motions, 'motion')} · ${count(segments.length, 'segment')}`;
}

/** Show where the playhead of a result is, in which `segment`; `labels` are those of poses side by side, or null. */
export function showMoment({ playhead, document: { energy }, seconds }, segment, labels) {
  const { frame, playing } = playhead;
  const field = $('frame');
  if (field !== document.activeElement) field.value = frameNumber(frame);
  $('seconds').textContent = clockTime(seconds);
  $('energy').textContent = energy[frame] === null ? '' : `energy ${energy[frame].toFixed(3)}`;
  document.body.classList.toggle('playing', playing);
  $('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
  $('timeline').setAttribute('aria-valuenow', frame);
  $('timeline').setAttribute('aria-valuetext', `frame ${frameText(frame)}, motion ${segment.name}`);
  showPoseLabels(labels);
}

/** Name the poses that the figure panel shows side by side: a segment and a text for each; null: there is one pose. */
export function showPoseLabels(labels) {
  const box = $('pair');
  box.hidden = !labels;
  const key = labels ? labels.map(({ segment, text, current }) => [segment.name, segment.motion, text, current].join()).join('|') : '';
  if (box.dataset.key === key) return;
  box.dataset.key = key;
  box.style.gridTemplateColumns = `repeat(${labels?.length ?? 1}, minmax(0, 1fr))`;
  box.replaceChildren(...(labels ?? []).map(({ segment, text, current }) => {
    const tag = make('span', { className: 'tag' });
    writeTag(tag, segment);
    return make('p', { className: current ? 'current' : '' }, tag, ' ', make('span', {}, text));
  }));
}

/** The labels of the two poses at a cut. */
export const cutLabels = ([before, after]) => [
  { segment: before, text: `ends with ${frameText(before.end - 1)}` },
  { segment: after, text: `begins with ${frameText(after.start)}` },
];
