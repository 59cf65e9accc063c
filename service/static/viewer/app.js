// The page: which of its four faces it shows (start, waiting, refused, result), and what leads from one to another.

import { frameOfAddress, remember, revisionOfAddress } from './address.js';
import * as api from './api.js';
import { controls, note, offerMethods } from './controls.js';
import { $ } from './dom.js';
import { face, refuse } from './faces.js';
import { drawHeatKey } from './heat.js';
import { beginProgress, progress, statusProgress } from './progress.js';
import { showRecent } from './recent.js';
import { Result } from './result.js';
import { about, count } from './numbers.js';
import { acceptFiles } from './upload.js';
import { finished } from './waiting.js';
import { wire } from './wiring.js';

let shown = null; // the Result on screen
let status = null; // its status document
let task = new AbortController(); // what the page is busy with; a newer one ends it

function begin() {
  task.abort();
  task = new AbortController();
  return task.signal;
}

/** Files a person gave: send them, have them cut, show the result. */
async function openFiles(files) {
  if (!(await leave())) return;
  const signal = begin();
  files = inOrder(files);
  $('subject').textContent = '';
  beginProgress(files[0].name);
  face('waiting', files[0].name);
  $('waiting-cancel').onclick = () => { history.pushState(null, '', '/'); route(); };
  try {
    progress('upload', 0);
    const animation = await api.upload(files, (share) => progress('upload', share), signal);
    const segmentation = await api.segment(animation.id);
    history.pushState(null, '', `/view/${segmentation.id}`);
    await follow(segmentation.id, signal);
  } catch (problem) { refuse(problem, files[0].name); }
}

/** The scene before its buffers: its name is the animation's. */
const inOrder = (files) => files.sort((a, b) => scene(b) - scene(a));
const scene = (file) => Number(/\.(glb|gltf|npz|bvh)$/i.test(file.name));

/** An animation seen before: its newest segmentation, or a first one. */
async function openAnimation(animation) {
  const signal = begin();
  beginProgress(animation.name);
  face('waiting', animation.name);
  try {
    const known = await api.segmentationsOf(animation.id).catch(() => null);
    const list = known?.segmentations || known?.items || [];
    const segmentation = list.find((one) => one.status === 'done') || list[0] || await api.segment(animation.id);
    history.pushState(null, '', `/view/${segmentation.id}`);
    await follow(segmentation.id, signal);
  } catch (problem) { refuse(problem); }
}

/** A segmentation in any state: wait until it is over, then show it. */
async function follow(id, signal) {
  $('waiting-cancel').onclick = () => api.cancel(id).catch(() => {}).finally(() => { history.pushState(null, '', '/'); route(); });
  status = await finished(id, (now) => {
    if (now.status === 'running') import('./stage.js'); // needed soon: fetched while we wait
    if (now.name) $('waiting-name').textContent = now.name;
    statusProgress(now);
  }, signal);
  const viewer = api.viewer(id); // asked for beside the result, as the figure takes longest
  viewer.catch(() => {}); // said where it is shown
  const result = await api.result(id, revisionOfAddress() ?? status.revision ?? 0);
  if (signal.aborted) return;
  show({ ...result, id }, viewer);
}

function show(result, viewer) {
  shown?.close();
  face('result', status.name);
  $('subject').textContent = [status.name, about(result)].filter(Boolean).join(' · ');
  $('result-title').textContent = status.name;
  shown = new Result(result, status.revision ?? 0, changed);
  shown.presence.look(document.querySelector('#looks input:checked').value);
  const frame = frameOfAddress();
  if (frame !== null) shown.clock.seek(frame);
  shown.clock.listen(remember);
  shown.presence.enter(result.id, viewer);
  changed();
}

/** The same take cut another way: the figure, the moment and the zoom stay. */
async function recut(changes) {
  const signal = begin();
  const result = shown;
  const waiting = setTimeout(() => note('Cutting again …'), 150);
  try {
    await result.editor.saving.flush();
    const parameters = { ...result.document.parameters, ...changes };
    const segmentation = await api.segment(status.animation, parameters);
    status = await finished(segmentation.id, () => {}, signal);
    const document = { ...(await api.result(segmentation.id, status.revision ?? 0)), id: segmentation.id };
    if (signal.aborted || shown !== result) return;
    history.pushState(null, '', `/view/${segmentation.id}${location.hash}`);
    result.show(document, status.revision ?? 0);
    note(`Now ${count(document.motions, 'motion')} in ${count(document.segments.length, 'segment')}.`);
  } catch (problem) {
    if (problem.name !== 'AbortError') note(problem.message);
  } finally { clearTimeout(waiting); }
}

/** Another revision of the same result, after what is open is kept (or, where it cannot be, dropped on purpose). */
async function openRevision(number, dropping = false) {
  const result = shown;
  const { id } = result.document;
  try {
    if (!dropping) await result.editor.saving.flush();
    const newest = dropping ? number : result.editor.saving.newest;
    const document = { ...(await api.result(id, number)), id };
    if (shown !== result) return;
    history.replaceState(null, '', `/view/${id}${number === newest ? '' : `?revision=${number}`}${location.hash}`);
    result.show(document, newest);
  } catch (problem) { note(problem.message); }
}

/** Whether the result on screen may be left: open edits are kept first. */
async function leave() {
  shown?.clock.toggle(false);
  if (!shown?.editor.saving.open) return true;
  return shown.editor.saving.flush().then(() => true, () => confirm('Your last edits could not be saved. Leave all the same?'));
}

/** What the address asks for. */
async function route() {
  const id = /^\/view\/([^/]+)$/.exec(location.pathname)?.[1];
  if (id && shown?.document.id === id && document.body.dataset.view === 'result') return;
  await leave();
  const signal = begin();
  if (!id) {
    $('subject').textContent = '';
    face('start');
    shown?.close();
    shown = null;
    showRecent(openAnimation);
    return;
  }
  beginProgress('');
  face('waiting');
  try { await follow(id, signal); } catch (problem) { refuse(problem); }
}

const onScreen = () => (document.body.dataset.view === 'result' ? shown : null);
const changed = wire({ shown: onScreen, name: () => status?.name, recut, openRevision, note });
controls({ recut, current: () => shown.document });
acceptFiles(openFiles);
addEventListener('popstate', route);
addEventListener('hashchange', () => { const frame = frameOfAddress(); if (frame !== null) shown?.clock.seek(frame); });
drawHeatKey();
offerMethods();
route();
