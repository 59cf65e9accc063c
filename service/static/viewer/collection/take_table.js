// The table of motions by takes: a row for each take with its strip, a column for each motion.

import { make, screenReaderText } from '../dom.js';
import { swatchOf } from '../palette.js';
import { setTabStop } from '../roving_focus.js';
import { segmentStrip } from '../start/segment_strip.js';

const STATES = { waiting: 'waiting', failed: 'not comparable' };

/**
 * Fill the table. `open(take, frame)` is called for a cell, `list(take)` for the name of a take. What has the focus keeps it.
 */
export function fillTakeTable(table, collection, { open, list }) {
  const focused = table.contains(document.activeElement) ? document.activeElement.dataset.key : null;
  const { motions } = collection.document;
  const takes = collection.takes.filter(({ status }) => status !== 'failed');
  table.replaceChildren(
    make('caption', { className: 'unseen' }, 'Seconds, segments and certainty of each motion in each take'),
    make('thead', {}, make('tr', {}, make('th', { scope: 'col', className: 'take-head' }, 'Take'), ...motions.map(({ id }) => motionHead(collection.motion(id))))),
    make('tbody', {}, ...takes.map((take) => takeRow(collection, take, { open, list }))));
  const kept = focused && [...table.querySelectorAll('button')].find(({ dataset }) => dataset.key === focused);
  setTabStop(table, 'button', kept || table.querySelector('button'));
  kept?.focus();
}

function motionHead({ name, colour, texture }) {
  return make('th', { scope: 'col' }, swatchOf(colour, texture), make('span', { className: 'head-name', title: name }, name));
}

function takeRow(collection, take, { open, list }) {
  const { animation, name, status, segments, frames } = take;
  const labelled = status === 'labelled';
  const button = make('button', { type: 'button', tabIndex: -1, 'data-key': animation, disabled: !labelled, title: name, onclick: () => list(take) }, name);
  const strip = make('span', { className: 'strip-place' }, labelled ? segmentStrip(collection.coloured(segments), frames) : STATES[status]);
  const shares = new Map(take.motions.map((share) => [share.motion, share]));
  const cells = collection.document.motions.map((motion) => cell(take, motion, shares.get(motion.id), open));
  return make('tr', {}, make('th', { scope: 'row' }, button, strip), ...cells);
}

function cell(take, { name, colour }, share, open) {
  if (!share) return make('td', { className: 'faint' }, '–');
  const { seconds, segments, confidence, start } = share;
  const sure = confidence === null ? '' : `${Math.round(100 * confidence)} %`;
  const button = make('button', { type: 'button', tabIndex: -1, title: 'Open the take there', 'data-key': `${take.animation} ${share.motion}`, onclick: () => open(take, start) },
    screenReaderText(`${name} in ${take.name}: `), make('b', {}, `${seconds.toFixed(1)} s`), make('small', {}, [`${segments}×`, sure].filter(Boolean).join(' · ')));
  button.style.setProperty('--colour', colour);
  button.style.setProperty('--share', `${100 * Math.min(1, (seconds * take.frame_rate) / take.frames)}%`);
  return make('td', {}, button);
}
