// How much each number of motions leaves unexplained, as a small chart; the number in use is marked. A click chooses another.

import { $ } from '../dom.js';

const WIDE = 280;
const HIGH = 64;
const EDGE = { left: 12, right: 12, top: 10, bottom: 18 };

const svg = (tag, attributes, text = '') => {
  const element = document.createElementNS($('scores').querySelector('svg').namespaceURI, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.textContent = text;
  return element;
};

/** Draw `scores` with `chosen` marked; hidden where there is nothing to compare. `choose(motions)` is called on a click. */
export function showScores(scores, chosen, choose) {
  $('scores').hidden = scores.length < 2;
  if (scores.length < 2) return;
  const chart = $('scores').querySelector('svg');
  const step = (WIDE - EDGE.left - EDGE.right) / (scores.length - 1);
  const most = Math.max(...scores.map(({ score }) => score)) || 1;
  const x = (i) => EDGE.left + i * step;
  const y = (score) => EDGE.top + (1 - Math.max(0, score) / most) * (HIGH - EDGE.top - EDGE.bottom);
  const every = Math.max(1, Math.ceil(scores.length / 12)); // numbers below, no more than are read
  const line = scores.map(({ score }, i) => `${i ? 'L' : 'M'}${x(i).toFixed(1)} ${y(score).toFixed(1)}`).join('');
  const at = scores.findIndex(({ motions }) => motions === chosen);
  const numbered = (i) => i === at || (i % every === 0 && Math.abs(i - at) >= every);
  chart.setAttribute('viewBox', `0 0 ${WIDE} ${HIGH}`);
  chart.setAttribute('aria-label', `Left unexplained by number of motions: ${scores.map(({ motions, score }) => `${motions}: ${Math.round(100 * score)} %`).join(', ')}. In use: ${chosen}.`);
  chart.replaceChildren(
    svg('path', { class: 'base', d: `M0 ${HIGH - EDGE.bottom + 0.5}H${WIDE}` }),
    ...(at < 0 ? [] : [svg('path', { class: 'drop-line', d: `M${x(at)} ${y(scores[at].score)}V${HIGH - EDGE.bottom}` })]),
    svg('path', { class: 'line', d: line }),
    ...scores.map(({ score }, i) => svg('circle', { class: i === at ? 'dot chosen' : 'dot', cx: x(i), cy: y(score), r: i === at ? 4.5 : 2.5 })),
    ...scores.map(({ motions }, i) => (numbered(i) ? svg('text', { x: x(i), y: HIGH - 4, class: i === at ? 'chosen' : '' }, motions) : null)).filter(Boolean),
    ...scores.map(({ motions, score }, i) => {
      const area = svg('rect', { x: x(i) - step / 2, y: 0, width: step, height: HIGH });
      area.append(svg('title', {}, `${motions}: ${Math.round(100 * score)} % left`));
      area.addEventListener('click', () => choose(motions));
      return area;
    }),
  );
}
