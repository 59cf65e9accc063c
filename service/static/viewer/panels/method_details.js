// What the paper's method saw on its way, where `details` were asked for: the variances between neighbouring motions (Eq. 5 of the
// paper), whose lowest points are the cuts, and the mean strain of the key-frames of each motion (Eq. 4).

import { $, make, makeSvg } from '../dom.js';
import { segmentIndexAt } from '../editing/segment_edits.js';
import { count, frameText } from '../number_format.js';
import { motionSwatch } from '../palette.js';

const WIDE = 280;
const HIGH = 72;
const BELOW = 14; // pixels for the numbers under the curves
const FINEST = 400; // points of a curve, more than there are pixels for

/** Show the details of a result; `goTo(frame)` is called for a cut that a person presses. */
export function showDetails(result, goTo) {
  const { variances = [], clusters = [] } = result; // results of before have none
  $('details').hidden = !variances.length && !clusters.length;
  $('variances').hidden = !variances.length;
  if (variances.length) drawVariances(result, goTo);
  $('clusters').replaceChildren(...clusters.map((cluster) => clusterRow(result, cluster)));
}

function drawVariances({ variances, frames }, goTo) {
  const most = Math.max(...variances.flatMap(({ values }) => values)) || 1;
  const x = (frame) => ((frame * WIDE) / (frames - 1)).toFixed(2);
  const y = (value) => (2 + (1 - value / most) * (HIGH - BELOW - 4)).toFixed(2);
  const path = ({ start, values }) => {
    const step = Math.max(1, Math.ceil(values.length / FINEST));
    return values.flatMap((value, i) => (i % step ? [] : [`${i ? 'L' : 'M'}${x(start + i)} ${y(value)}`])).join('');
  };
  const chart = $('variances').querySelector('svg');
  chart.setAttribute('viewBox', `0 0 ${WIDE} ${HIGH}`);
  chart.setAttribute('aria-label', `Variance between neighbouring motions. It is least at frames ${variances.map(({ boundary }) => frameText(boundary)).join(', ')}, where the take is cut.`);
  chart.replaceChildren(
    makeSvg('path', { class: 'base', d: `M0 ${HIGH - BELOW + 0.5}H${WIDE}` }),
    ...variances.map(({ boundary }) => makeSvg('path', { class: 'drop-line', d: `M${x(boundary)} 2V${HIGH - BELOW}` })),
    ...variances.map((curve) => makeSvg('path', { class: 'line', d: path(curve) })),
    makeSvg('text', { x: 0, y: HIGH - 2 }, frameText(0)),
    makeSvg('text', { x: WIDE, y: HIGH - 2, class: 'last' }, frameText(frames - 1)),
    ...variances.map(({ start, values, boundary }) => {
      const area = makeSvg('rect', { x: x(start), y: 0, width: x(values.length), height: HIGH - BELOW });
      area.append(makeSvg('title', {}, `Cut at frame ${frameText(boundary)}`));
      area.addEventListener('click', () => goTo(boundary));
      return area;
    }),
  );
}

function clusterRow({ segments }, { key_frames: keys, mean_strain: strain }) {
  const { motion, name } = segments[segmentIndexAt(segments, keys[0])];
  return make('li', {}, motionSwatch(motion), make('span', { className: 'name', title: name }, name),
    make('span', { className: 'faint' }, count(keys.length, 'key-frame')), make('span', { className: 'long' }, strain.toFixed(3)));
}
