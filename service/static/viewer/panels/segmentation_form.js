// The form of a segmentation: the number of motions, with a chart of their errors, and the method. A change is asked of the
// same animation, which the service has analysed already.

import * as api from '../service/api.js';
import { waitUntilDone } from '../service/job_status.js';
import { $, make, makeSvg } from '../dom.js';
import { count } from '../number_format.js';
import { addAdvancedSettings, offerSettings, showSettings } from './advanced_settings.js';

const DELAY = 350; // ms of quiet before a typed or stepped number is sent
const SOON = 150; // ms after which the form says that it waits

let choose = () => {};
let most = Infinity; // motions that the service takes; it says so in its list of methods
let needsNumber = new Set(); // the methods that cannot find the number of motions themselves
let shownSettings = null; // the document whose settings are shown
let compared = { of: '', scores: [] }; // a result of a given number has no scores: those of the same method stay

/** Wire the form once. `resegment(changes)` posts; `current()` is the result on screen. */
export function addSegmentationForm({ resegment, current }) {
  const field = $('motions');
  let timer;
  const send = (changes, delay = 0) => {
    clearTimeout(timer);
    timer = setTimeout(() => resegment(changes), delay);
  };
  const typed = () => {
    const text = field.value.trim().toLowerCase();
    if (text === '' || text === 'auto') return 'auto';
    const number = Number(text);
    return Number.isInteger(number) && number > 0 && number <= most ? number : null;
  };
  const step = (by) => {
    const from = typed();
    const number = Math.max(1, Math.min(most, (from === 'auto' || from === null ? current().document.motions : from) + by));
    field.value = number;
    $('auto').setAttribute('aria-pressed', 'false');
    send({ motions: number }, DELAY);
  };
  choose = (number) => { field.value = number; send({ motions: number }); };
  $('fewer').addEventListener('click', () => step(-1));
  $('more').addEventListener('click', () => step(1));
  $('auto').addEventListener('click', () => { field.value = ''; send({ motions: 'auto' }); });
  field.addEventListener('keydown', (event) => {
    if (event.key === 'ArrowUp') { event.preventDefault(); step(1); }
    if (event.key === 'ArrowDown') { event.preventDefault(); step(-1); }
  });
  field.addEventListener('change', () => {
    const motions = typed();
    if (motions === null) showFormNote(`Type a whole number of motions up to ${most}, or auto.`);
    else if (motions === 'auto' && needsNumber.has(current().document.method)) showFormNote(`The method ${current().document.method} needs a number of motions.`);
    else send({ motions });
  });
  $('method').addEventListener('change', ({ target: { value: method } }) => {
    send(needsNumber.has(method) && typed() === 'auto' ? { method, motions: current().document.motions } : { method });
  });
  addAdvancedSettings(() => current().document.parameters, (changes) => resegment(changes));
  $('controls').addEventListener('submit', (event) => event.preventDefault());
}

/** Say a sentence below the form, and offer ways on. */
export function showFormNote(sentence, ...ways) { $('controls-note').replaceChildren(sentence, ...ways); }

/** Say one more sentence, after what the form says already; the last one of these is in its place. */
export function addFormNote(sentence, ...ways) {
  $('controls-note').querySelector('.edits-elsewhere')?.remove();
  $('controls-note').append(make('span', { className: 'edits-elsewhere' }, ' ', sentence, ...ways));
}

/** Show what the document was made with. `found` is how many motions the method found, which may be fewer than were asked for. */
export function showParameters(document, found = document.motions) {
  const { motions: asked } = document.parameters;
  const auto = asked === 'auto' || asked === undefined;
  const motions = found ?? asked;
  $('motions').value = auto ? '' : motions;
  $('motions').placeholder = document.motions;
  $('auto').setAttribute('aria-pressed', String(auto));
  $('auto').disabled = needsNumber.has(document.method);
  const select = $('method');
  if (![...select.options].some((option) => option.value === document.method)) select.append(option(document.method));
  select.value = document.method;
  shownSettings = document;
  showSettings(document);
  const of = [document.source.name, document.frames, document.method, document.parameters.take].join();
  if (compared.of !== of || document.scores.length > 1) compared = { of, scores: document.scores };
  const chosen = auto ? document.motions : motions; // of a revision, what is shown; else what was asked for
  showScores(compared.scores, chosen, choose);
}

/** Segment the take of a result with other parameters, after the open edits are saved. */
export async function resegment(result, changes, signal) {
  const waiting = setTimeout(() => showFormNote('Segmenting again …'), SOON);
  try {
    const { saving } = result.editor;
    await saving.flush();
    const { id } = await api.segment(result.status.animation, { ...result.document.parameters, ...changes });
    const status = await waitUntilDone(id, () => {}, signal);
    const document = await api.result(id, status.revision);
    if (signal.aborted || result.closed) return;
    const left = id !== result.document.id && saving.shown > 0;
    history.pushState(null, '', `/view/${id}${location.hash}`);
    result.show(document, status);
    showFormNote(`The take now has ${count(document.motions, 'motion')} in ${count(document.segments.length, 'segment')}.${left ? ' Your edits belong to the result before: go back to see them.' : ''}`);
  } catch (problem) {
    if (problem.name === 'AbortError' || result.closed) return;
    showFormNote(problem.message);
    showParameters(result.document, result.status.motions);
  } finally { clearTimeout(waiting); }
}

const option = (name, title = '') => make('option', { value: name, title }, name);

/** Fill the menu of methods from the service's list. */
export async function offerMethods() {
  const answer = await api.methods().catch(() => null);
  if (!answer) return;
  needsNumber = new Set(answer.methods.filter(({ parameters }) => parameters.required?.includes('motions')).map(({ name }) => name));
  most = answer.methods[0].parameters.properties.motions.anyOf.find(({ type }) => type === 'integer').maximum;
  const chosen = $('method').value;
  offerSettings(answer.methods);
  if (shownSettings) showSettings(shownSettings);
  $('method').replaceChildren(...answer.methods.map(({ name, description }) => option(name, description)));
  if (chosen) $('method').value = chosen;
  $('auto').disabled = needsNumber.has(chosen);
}

const WIDE = 280;
const HIGH = 64;
const EDGE = { left: 12, right: 12, top: 10, bottom: 18 };

/** Draw `scores` with `chosen` marked; hidden where there is nothing to compare. `choose(motions)` is called on a click. */
function showScores(scores, chosen, choose) {
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
  chart.setAttribute('aria-label', `Error for each number of motions: ${scores.map(({ motions, score }) => `${motions}: ${Math.round(100 * score)} %`).join(', ')}. This result has ${chosen}.`);
  chart.replaceChildren(
    makeSvg('path', { class: 'base', d: `M0 ${HIGH - EDGE.bottom + 0.5}H${WIDE}` }),
    ...(at < 0 ? [] : [makeSvg('path', { class: 'drop-line', d: `M${x(at)} ${y(scores[at].score)}V${HIGH - EDGE.bottom}` })]),
    makeSvg('path', { class: 'line', d: line }),
    ...scores.map(({ score }, i) => makeSvg('circle', { class: i === at ? 'dot chosen' : 'dot', cx: x(i), cy: y(score), r: i === at ? 4.5 : 2.5 })),
    ...scores.map(({ motions }, i) => (numbered(i) ? makeSvg('text', { x: x(i), y: HIGH - 4, class: i === at ? 'chosen' : '' }, motions) : null)).filter(Boolean),
    ...scores.map(({ motions, score }, i) => {
      const area = makeSvg('rect', { x: x(i) - step / 2, y: 0, width: step, height: HIGH });
      area.append(makeSvg('title', {}, `${count(motions, 'motion')}: ${Math.round(100 * score)} % error`));
      area.addEventListener('click', () => choose(motions));
      return area;
    }),
  );
}
