// The export panel: for which program, which segments, as how many files, and how the clips are called, with their names as
// they will be.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { count, duration } from '../number_format.js';
import { store, stored } from '../local_storage.js';
import { motionSwatch } from '../palette.js';
import { loopText } from '../editing/segment_loop.js';
import { download } from './download.js';

const KEY = 'caesura.export';
const QUIET = 200; // ms after the last change before the names are asked for

let engines = null; // that the service knows, once it has said so
let asked = 0;

/** Open the panel. `shown()` is as for `download`, with the segments and the index of the current one. */
export async function openExportPanel(shown) {
  const form = $('export-form');
  if (!engines) {
    engines = []; // a second press while the service is asked wires nothing again
    await offerEngines();
    wire(shown, form);
  }
  set(form, stored(KEY, {}));
  note('');
  showAdvice();
  $('export-dialog').showModal();
  preview(shown, form);
}

function wire(shown, form) {
  let timer;
  const changed = () => {
    showAdvice();
    store(KEY, settings(form));
    clearTimeout(timer);
    timer = setTimeout(() => preview(shown, form), QUIET);
  };
  form.addEventListener('input', changed);
  form.elements.engine.addEventListener('change', () => set(form, engines.find(({ name }) => name === form.elements.engine.value).options));
  form.addEventListener('submit', (event) => {
    event.preventDefault();
    download(shown, 'clips', choices(form, shown()), note);
  });
  $('export-close').addEventListener('click', () => $('export-dialog').close());
}

/** Offer the programs that the service lists. */
async function offerEngines() {
  ({ engines } = await api.exports().catch(() => ({ engines })));
  $('export-form').elements.engine.replaceChildren(...engines.map(({ name, title }) => make('option', { value: name }, title)));
}

const note = (sentence) => { $('export-note').textContent = sentence; };

function showAdvice() {
  const engine = engines.find(({ name }) => name === $('export-form').elements.engine.value);
  $('export-advice').textContent = engine?.advice ?? '';
}

/** What is set, but for which segments: that is of one result alone. */
function settings({ elements }) {
  const texts = ['engine', 'files', 'handles_seconds', 'names', 'loop', 'loop_blend_seconds'];
  const checks = ['animation_only', 'split_repeats', 'keep_source', 'in_place'];
  return Object.fromEntries([...texts.map((name) => [name, elements[name].value]), ...checks.map((name) => [name, elements[name].checked])]);
}

function set({ elements }, values) {
  for (const [name, value] of Object.entries(values)) {
    const field = elements[name];
    if (!field || value === '') continue;
    if (field.type === 'checkbox') field.checked = value === true || value === 'true'; else field.value = value;
  }
}

/** The choices of clips as the service takes them. */
function choices(form, { affected }) {
  const { engine, in_place: inPlace, ...given } = settings(form);
  const { which, numbers } = form.elements;
  const only = { all: '', current: affected.map((index) => index + 1).join(), chosen: numbers.value.replaceAll(' ', '') }[which.value];
  const plain = { files: 'one', handles_seconds: '0', names: '{motion}_{number}', loop_blend_seconds: '0' };
  return Object.fromEntries(Object.entries({ ...given, only, root: inPlace && 'in_place' })
    .filter(([name, value]) => value && value !== plain[name]).map(([name, value]) => [name, String(value)]));
}

/** List the names that the clips will have. */
async function preview(shown, form) {
  const turn = ++asked;
  form.elements.numbers.hidden = form.elements.which.value !== 'chosen';
  const { id, keep } = shown();
  const saved = await keep().then(() => true, () => false);
  const plan = await api.clipPlan(id, shown().revision, choices(form, shown())).catch((problem) => ({ problem }));
  if (turn !== asked) return;
  const { clips = [], problem } = plan;
  $('export-count').textContent = problem ? problem.message : count(clips.length, 'clip') + (saved ? '' : '. Your last edits are not saved yet.');
  $('export-count').classList.toggle('problem-line', Boolean(problem));
  const { segments } = shown();
  $('export-names').replaceChildren(...clips.map(({ name, segment, loop, start_seconds: start, end_seconds: end }) => make('li', {},
    motionSwatch(segments[segment - 1]?.motion ?? 0), make('span', { className: 'name', title: name }, name),
    loop ? make('span', { className: `match ${loop.match}`, title: loopText(loop) }, `↻ ${loop.match}`) : null,
    make('span', { className: 'long' }, duration(end - start)))));
  $('export-save').disabled = Boolean(problem);
}
