// Another number of motions, another method: asked of the same animation, so the vertices are not touched again.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { showScores } from './score_chart.js';

const DELAY = 350; // ms of quiet before a typed or stepped number is sent
const MOST = 1000; // motions; the service takes no more

let choose = () => {};
let told = new Set(); // the methods that cannot find the number of motions themselves
let compared = { of: '', scores: [] }; // a cut into a given number has no scores: those of the same method stay

/** Wire the form once. `recut(changes)` posts; `current()` is the document on screen. */
export function controls({ recut, current }) {
  const field = $('motions');
  let timer;
  const send = (changes, delay = 0) => {
    clearTimeout(timer);
    timer = setTimeout(() => recut(changes), delay);
  };
  const typed = () => {
    const text = field.value.trim().toLowerCase();
    if (text === '' || text === 'auto') return 'auto';
    const number = Number(text);
    return Number.isInteger(number) && number > 0 && number <= MOST ? number : null;
  };
  const step = (by) => {
    const from = typed();
    const number = Math.max(1, Math.min(MOST, (from === 'auto' || from === null ? current().motions : from) + by));
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
    if (motions === null) note(`A whole number of motions up to ${MOST}, or auto.`);
    else if (motions === 'auto' && told.has(current().method)) note(`The method ${current().method} must be told a number.`);
    else send({ motions });
  });
  $('method').addEventListener('change', ({ target: { value: method } }) => {
    send(told.has(method) && typed() === 'auto' ? { method, motions: current().motions } : { method });
  });
  $('controls').addEventListener('submit', (event) => event.preventDefault());
}

export function note(sentence) { $('controls-note').textContent = sentence; }

/** Show what the document was made with. */
export function reflect(document) {
  const { motions } = document.parameters;
  const auto = motions === 'auto' || motions === undefined;
  $('motions').value = auto ? '' : motions;
  $('motions').placeholder = document.motions;
  $('auto').setAttribute('aria-pressed', String(auto));
  $('auto').disabled = told.has(document.method);
  const select = $('method');
  if (![...select.options].some((option) => option.value === document.method)) select.append(option(document.method));
  select.value = document.method;
  const of = [document.source.name, document.frames, document.method, document.parameters.take].join();
  if (compared.of !== of || document.scores.length > 1) compared = { of, scores: document.scores };
  const chosen = auto ? document.motions : motions; // of a revision, what is shown; else what was asked for
  showScores(compared.scores, chosen, choose);
}

const option = (name, title = '') => make('option', { value: name, title }, name);

/** Fill the choice of methods from what the service offers. */
export async function offerMethods() {
  const answer = await api.methods().catch(() => null);
  if (!answer) return;
  told = new Set(answer.methods.filter(({ parameters }) => parameters.required?.includes('motions')).map(({ name }) => name));
  const chosen = $('method').value;
  $('method').replaceChildren(...answer.methods.map(({ name, description }) => option(name, description)));
  if (chosen) $('method').value = chosen;
  $('auto').disabled = told.has(chosen);
}
