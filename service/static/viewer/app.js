// The page: which of its four faces it shows (start, waiting, refused, result), and what leads from one to another.

import * as api from './api.js';
import { controls, note, offerMethods } from './controls.js';
import { $ } from './dom.js';
import { keyboard } from './keyboard.js';
import { count } from './numbers.js';
import { beginProgress, progress, statusProgress } from './progress.js';
import { showRecent } from './recent.js';
import { Result, about, drawHeatKey } from './result.js';
import { acceptFiles } from './upload.js';
import { finished } from './waiting.js';

let shown = null; // the Result on screen
let status = null; // its status document
let task = new AbortController(); // what the page is busy with; a newer one ends it

function face(name, title = '') {
  document.body.dataset.view = name;
  document.title = title ? `${title} · Caesura` : 'Caesura';
}

function begin() {
  task.abort();
  task = new AbortController();
  return task.signal;
}

function refuse(problem) {
  if (problem.name === 'AbortError') return;
  if (!(problem instanceof api.Problem)) console.error(problem);
  const { pointer, parameter, frame, code } = problem.document || {};
  $('refused-detail').textContent = problem instanceof api.Problem ? problem.message : 'The page itself failed; the console says where.';
  $('refused-where').textContent = [code, pointer, parameter, frame !== undefined && `frame ${frame}`].filter(Boolean).join(' · ');
  face('refused', 'Problem');
}

/** Files a person gave: send them, have them cut, show the result. */
async function openFiles(files) {
  const signal = begin();
  files = inOrder(files);
  shown?.clock.toggle(false);
  $('subject').textContent = '';
  beginProgress(files[0].name);
  face('waiting', files[0].name);
  try {
    progress('upload', 0);
    const animation = await api.upload(files, (share) => progress('upload', share), signal);
    const segmentation = await api.segment(animation.id);
    history.pushState(null, '', `/view/${segmentation.id}`);
    await follow(segmentation.id, signal);
  } catch (problem) { refuse(problem); }
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
  import('./stage.js'); // needed soon: fetched while we wait
  $('waiting-cancel').onclick = () => api.cancel(id).catch(() => {}).finally(() => { history.pushState(null, '', '/'); route(); });
  status = await finished(id, (now) => {
    if (now.name) $('waiting-name').textContent = now.name;
    statusProgress(now);
  }, signal);
  const result = await api.result(id);
  if (signal.aborted) return;
  show({ ...result, id });
}

function show(result) {
  shown?.close();
  face('result', status.name);
  $('subject').textContent = [status.name, about(result)].filter(Boolean).join(' · ');
  shown = new Result(result);
  shown.look(document.querySelector('#looks input:checked').value);
  const frame = frameOfAddress();
  if (frame !== null) shown.clock.seek(frame);
  shown.clock.listen(remember);
  shown.figure();
}

/** The same take cut another way: the figure, the moment and the zoom stay. */
async function recut(changes) {
  const signal = begin();
  const result = shown;
  const waiting = setTimeout(() => note('Cutting again …'), 150);
  try {
    const parameters = { ...result.document.parameters, ...changes };
    const segmentation = await api.segment(status.animation, parameters);
    status = await finished(segmentation.id, () => {}, signal);
    const document = { ...(await api.result(segmentation.id)), id: segmentation.id };
    if (signal.aborted || shown !== result) return;
    history.pushState(null, '', `/view/${segmentation.id}${location.hash}`);
    result.show(document);
    note(changed(document));
  } catch (problem) {
    if (problem.name !== 'AbortError') note(problem.message);
  } finally { clearTimeout(waiting); }
}

const changed = (document) => `Now ${count(document.motions, 'motion')} in ${count(document.segments.length, 'segment')}.`;

const frameOfAddress = () => {
  const match = /[#&]frame=(\d+)/.exec(location.hash);
  return match ? Number(match[1]) : null;
};

/** Keep the moment in the address, once it rests: browsers refuse to be told sixty times a second. */
let resting;
function remember(clock) {
  clearTimeout(resting);
  if (clock.playing) return;
  resting = setTimeout(() => {
    if (document.body.dataset.view === 'result') history.replaceState(null, '', `${location.pathname}#frame=${clock.frame}`);
  }, 250);
}

/** What the address asks for. */
async function route() {
  const id = /^\/view\/([^/]+)$/.exec(location.pathname)?.[1];
  if (id && shown?.document.id === id) return;
  const signal = begin();
  shown?.clock.toggle(false);
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

function wire() {
  const on = (id, event, action) => $(id).addEventListener(event, action);
  on('play', 'click', () => shown.clock.toggle());
  on('previous', 'click', () => shown.jump(-1));
  on('next', 'click', () => shown.jump(1));
  on('speed', 'change', (event) => { shown.clock.speed = Number(event.target.value); });
  on('loop', 'change', (event) => shown.loop(event.target.checked));
  on('frame', 'focus', (event) => event.target.select());
  on('frame', 'keydown', (event) => { if (event.key === 'Enter' || event.key === 'Escape') event.target.blur(); });
  on('frame', 'change', (event) => {
    const frame = event.target.value.replace(/\s/g, '');
    if (/^\d+$/.test(frame)) { shown.clock.seek(Number(frame)); shown.span.reveal(shown.clock.frame); }
  });
  on('frame', 'blur', () => shown.clock.tell()); // what was typed and is no frame goes back to the one shown
  on('zoom-in', 'click', () => shown.span.zoom(1.6, shown.clock.frame));
  on('zoom-out', 'click', () => shown.span.zoom(1 / 1.6, shown.clock.frame));
  on('zoom-fit', 'click', () => shown.span.all());
  on('reframe', 'click', () => shown.stage?.reframe());
  on('follow', 'change', (event) => { if (shown.stage) shown.stage.following = event.target.checked; });
  on('upright', 'click', (event) => {
    const pressed = event.target.getAttribute('aria-pressed') !== 'true';
    event.target.setAttribute('aria-pressed', String(pressed));
    shown.stage?.turn(pressed);
  });
  on('looks', 'change', (event) => shown.look(event.target.value));
  controls({ recut, current: () => shown.document });
  keyboard({ clock: () => (document.body.dataset.view === 'result' ? shown?.clock : null), span: () => shown.span, jump: (by) => shown.jump(by) });
  acceptFiles(openFiles);
  addEventListener('popstate', route);
  addEventListener('hashchange', () => { const frame = frameOfAddress(); if (frame !== null) shown?.clock.seek(frame); });
}

wire();
drawHeatKey();
offerMethods();
route();
