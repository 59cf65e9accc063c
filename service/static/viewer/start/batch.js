// Several animations at once: each is sent and segmented by itself, one that is refused stops no other, and the good ones make
// a collection.

import { $, announce } from '../dom.js';
import { store, stored } from '../local_storage.js';
import { count } from '../number_format.js';
import { showView } from '../views.js';
import { batchRow, showRow } from './batch_row.js';
import { followJob } from '../service/job_polling.js';
import { stageText } from './progress.js';

const AT_ONCE = 2; // that are being sent; the service queues them
const SENT = 0.2; // of the bar of a row is the sending
const KEY = 'caesura.batch';
const AWAY = 'The service does not answer. The page tries again.';

const ADDRESS = '/#batch';

let batch = null; // `{ title, rows }`; a row is `{ name, id, animation, said, share, problem, done }`, and its elements while on screen
let ways = {};

/** Wire the view once. `open(id)` is called for a result that a person chooses, `together(animations)` makes a collection. */
export function addBatch({ open, together }) {
  ways = { open };
  const button = $('batch-together').querySelector('button');
  button.addEventListener('click', async () => {
    button.disabled = true;
    await together(goodAnimations()).catch(({ message }) => { $('batch-summary').textContent = message; });
    button.disabled = false;
  });
}

/** Start a batch and show it. An item is `{ name, send(onShare) }`, which answers a segmentation; `title` says what it is. */
export async function startBatch(title, items) {
  batch = { title, rows: items.map(({ name }) => ({ name, said: 'Waiting' })) };
  const left = items.map((item, place) => ({ item, row: batch.rows[place] }));
  remember();
  history.pushState(null, '', ADDRESS);
  showBatch();
  const work = async () => { while (left.length) await send(left.shift()); };
  await Promise.all(Array.from({ length: AT_ONCE }, work));
}

async function send({ item, row }) {
  try {
    const { id, animation } = await item.send((share) => change(row, { said: `Sending, ${Math.round(100 * share)} %`, share: SENT * share }));
    change(row, { id, animation, said: 'Waiting for a free worker', share: SENT });
    follow(row); // while the next ones are sent
  } catch ({ message }) { change(row, { problem: message }); }
  remember();
}

async function follow(row) {
  const tell = ({ status, progress }) => change(row, status === 'queued' ? { said: 'Waiting for a free worker', share: SENT }
    : { said: stageText(progress?.stage), share: SENT + (1 - SENT) * (progress?.overall ?? 0) });
  try {
    const done = await followJob(row.id, tell, () => change(row, { said: AWAY }));
    change(row, { done, animation: done.animation });
  } catch ({ message }) { change(row, { problem: message }); }
}

/** Show the batch, or the one that this tab remembers. Answers whether there is one. */
export function showBatch() {
  batch ??= restored();
  if (!batch) return false;
  $('batch-title').textContent = batch.title;
  const items = batch.rows.map((row) => [row, batchRow(row, ({ id }) => ways.open(id))]);
  $('batch-rows').replaceChildren(...items.filter(([{ problem }]) => !problem).map(([, item]) => item));
  $('batch-bad-rows').replaceChildren(...items.filter(([{ problem }]) => problem).map(([, item]) => item));
  showSummary();
  showView('batch', batch.title);
  return true;
}

function restored() {
  const kept = stored(KEY, null, sessionStorage);
  for (const row of kept?.rows ?? []) {
    if (row.problem) continue;
    if (row.id) follow(row);
    else row.problem = 'It was not sent. Open it again.';
  }
  return kept;
}

const remember = () => store(KEY, { title: batch.title, rows: batch.rows.map(({ name, id, problem }) => ({ name, id, problem })) }, sessionStorage);

/** Change a row, and show it as it is then: a bad one apart. */
function change(row, changes) {
  Object.assign(row, changes);
  showRow(row);
  if (row.problem && row.elements) $('batch-bad-rows').append(row.elements.item);
  if ((row.problem || row.done) && batch.rows.includes(row)) showSummary();
}

/** How many are ready and how many are bad; and once all are one or the other, the way to a collection. */
function showSummary() {
  const { rows } = batch;
  const good = rows.filter(({ done }) => done).length;
  const bad = rows.filter(({ problem }) => problem).length;
  $('batch-bar').value = (good + bad) / rows.length;
  $('batch-summary').textContent = `${good} of ${rows.length} ready${bad ? `, ${bad} could not be used` : ''}`;
  $('batch-bad').hidden = !bad;
  $('batch-bad-title').textContent = `${count(bad, 'file')} could not be used`;
  const whole = good + bad === rows.length && goodAnimations().length > 1;
  if (whole && $('batch-together').hidden) announce('All files are ready. Find the same motions in all.');
  $('batch-together').hidden = !whole;
}

const goodAnimations = () => [...new Set(batch.rows.filter(({ done }) => done).map(({ animation }) => animation))];
