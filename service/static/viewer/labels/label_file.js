// Labels that somebody made elsewhere: a CSV, an EAF of ELAN, or a JSON, read as segments in frames of the take on screen.

const NAMES = ['name', 'label', 'motion', 'annotation'];
const MOST = 100_000; // labels

/** What is wrong with a file of labels, in a sentence. */
export class LabelProblem extends Error {}

/** The segments of `text`, `{ start, end, name }` in frames, in the order of time. `document` says the rate and the first second. */
export function readLabels(text, document) {
  const read = /^\s*</.test(text) ? fromEaf : /^\s*[{[]/.test(text) ? fromJson : fromCsv;
  const found = read(text, (seconds) => (seconds - document.source.start_seconds) * document.frame_rate, document)
    .map(({ start, end, name }) => ({ start: Math.max(0, Math.round(start)), end: Math.min(document.frames, Math.round(end)), name: String(name ?? '').trim() || '?' }))
    .filter(({ start, end }) => end > start)
    .sort((one, other) => one.start - other.start);
  if (!found.length) throw new LabelProblem('The file has no labels within this take.');
  if (found.length > MOST) throw new LabelProblem(`The file has more than ${MOST} labels.`);
  return found;
}

/** A segmentation document, a truth, or a list: `start` and `end` in frames of its own rate, or `start_seconds` and `end_seconds`. */
function fromJson(text, frameAt, { frame_rate: rate }) {
  let parsed;
  try { parsed = JSON.parse(text); } catch { throw new LabelProblem('The file is no JSON.'); }
  const list = Array.isArray(parsed) ? parsed : parsed.segments;
  if (!Array.isArray(list)) throw new LabelProblem('The JSON has no list of segments.');
  const scale = rate / (parsed.frame_rate ?? parsed.fps ?? rate);
  return list.map((entry) => label(entry, frameAt, scale));
}

/** A table with a header: `start` and `end` in frames, or `start_seconds` and `end_seconds`, and a `name` or `label`. */
function fromCsv(text, frameAt) {
  const [header, ...rows] = text.trim().split(/\r?\n/).map(cells);
  const names = header.map((name) => name.trim().toLowerCase());
  if (!names.some((name) => name.startsWith('start'))) {
    throw new LabelProblem('The table needs a header with start, end and name, or start_seconds, end_seconds and name.');
  }
  return rows.map((row) => label(Object.fromEntries(names.map((name, i) => [name, row[i]])), frameAt, 1));
}

/** The cells of a line; those in quotes may hold commas, and quotes twice. */
function cells(line) {
  const separator = line.includes('\t') ? '\t' : line.includes(';') && !line.includes(',') ? ';' : ',';
  const found = [];
  let [cell, quoted] = ['', false];
  for (let i = 0; i < line.length; i++) {
    const letter = line[i];
    if (letter === '"' && quoted && line[i + 1] === '"') { cell += '"'; i += 1; }
    else if (letter === '"') quoted = !quoted;
    else if (letter === separator && !quoted) { found.push(cell); cell = ''; }
    else cell += letter;
  }
  return [...found, cell];
}

function label(entry, frameAt, scale) {
  const name = entry[NAMES.find((key) => entry[key] !== undefined)];
  const number = (value) => (value === undefined || value === '' ? NaN : Number(value));
  const [start, end] = [number(entry.start), number(entry.end)];
  if (Number.isFinite(start) && Number.isFinite(end)) return { start: start * scale, end: end * scale, name };
  const [from, to] = [number(entry.start_seconds), number(entry.end_seconds)];
  if (Number.isFinite(from) && Number.isFinite(to)) return { start: frameAt(from), end: frameAt(to), name };
  throw new LabelProblem('A label has no start and end that are numbers.');
}

/** The first tier of an EAF that has annotations with times. */
function fromEaf(text, frameAt) {
  const xml = new DOMParser().parseFromString(text, 'application/xml');
  if (xml.querySelector('parsererror')) throw new LabelProblem('The file is no EAF.');
  const times = new Map([...xml.querySelectorAll('TIME_SLOT')].map((slot) => [slot.getAttribute('TIME_SLOT_ID'), Number(slot.getAttribute('TIME_VALUE')) / 1000]));
  const tier = [...xml.querySelectorAll('TIER')].find((one) => one.querySelector('ALIGNABLE_ANNOTATION'));
  if (!tier) throw new LabelProblem('The EAF has no annotations with times.');
  return [...tier.querySelectorAll('ALIGNABLE_ANNOTATION')].map((annotation) => ({
    start: frameAt(times.get(annotation.getAttribute('TIME_SLOT_REF1'))),
    end: frameAt(times.get(annotation.getAttribute('TIME_SLOT_REF2'))),
    name: annotation.textContent,
  }));
}
