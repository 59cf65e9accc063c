// The page: what leads from one of its views to another, and every control of a result, wired once.

import { face, frameOfAddress, refuse, remember, resultOfAddress, revisionOfAddress } from './views.js';
import * as api from './service/api.js';
import { controls, note, offerMethods, recut } from './panels/segmentation_form.js';
import { $, announce } from './dom.js';
import { beginProgress, progress, statusProgress } from './start/progress.js';
import { showRecent } from './start/recent_animations.js';
import { Result } from './result.js';
import { about, count } from './number_format.js';
import { acceptFiles } from './start/file_drop.js';
import { finished } from './service/job_status.js';
import { editBar } from './editing/edit_toolbar.js';
import { help, keyboard } from './keyboard.js';
import { reviewTools } from './panels/cut_review.js';
import { downloads } from './panels/export_menu.js';
import { openRevision, revisionList, showRevisions } from './panels/revision_list.js';
import { segmentList } from './panels/segment_list.js';
import { tabs } from './roving_focus.js';
import { playback, view } from './timeline/navigation.js';

let shown = null; // the Result on screen
let task = new AbortController(); // what the page is busy with; a newer one ends it

function begin() {
  task.abort();
  task = new AbortController();
  return task.signal;
}

/** Wait for something: answers the signal that ends it. `cancel()` is what the button does beside leaving. */
function wait(name, cancel = async () => {}) {
  const signal = begin();
  $('subject').textContent = '';
  beginProgress(name);
  face('waiting', name);
  onCancel(cancel);
  return signal;
}

function onCancel(cancel) {
  $('waiting-cancel').onclick = () => cancel().finally(() => { history.pushState(null, '', '/'); route(); });
}

/** Files a person gave: send them, have them cut, show the result. */
async function openFiles(files) {
  if (!(await leave())) return;
  const { name } = files[0];
  const signal = wait(name);
  try {
    progress('upload', 0);
    const animation = await api.upload(files, (share) => progress('upload', share), signal);
    await openSegmentation(await api.segment(animation.id), signal);
  } catch (problem) { refuse(problem, name, () => openFiles(files)); }
}

/** An animation seen before: its newest segmentation that is there or on its way, else one more. */
async function openAnimation(animation) {
  const { id, name } = animation;
  const signal = wait(name);
  try {
    const { segmentations } = await api.segmentationsOf(id);
    const being = (...states) => segmentations.find(({ status }) => states.includes(status));
    await openSegmentation(being('done') || being('queued', 'running') || await api.segment(id), signal);
  } catch (problem) { refuse(problem, name, () => openAnimation(animation)); }
}

async function openSegmentation({ id }, signal) {
  if (signal.aborted) return;
  history.pushState(null, '', `/view/${id}`);
  await follow(id, signal);
}

/** A segmentation in any state: wait until it is over, then show it. */
async function follow(id, signal) {
  const status = await finished(id, (now) => {
    if (now.status === 'running') import('./figure/scene.js'); // needed soon: fetched while we wait
    if (now.name) $('waiting-name').textContent = now.name;
    onCancel(now.status === 'done' ? async () => {} : () => api.cancel(id).catch(() => {})); // to cancel what is done is to delete it
    statusProgress(now);
  }, signal);
  const viewer = api.viewer(id); // asked for beside the result, as the figure takes longest
  viewer.catch(() => {}); // said where it is shown
  const result = await api.result(id, revisionOfAddress() ?? status.revision);
  if (!signal.aborted) show(result, status, viewer);
}

function show(result, status, viewer) {
  shown?.close();
  note('');
  face('result', status.name);
  $('subject').textContent = [status.name, about(result)].filter(Boolean).join(' · ');
  $('result-title').textContent = status.name;
  announce(`${status.name}: ${count(result.motions, 'motion')} in ${count(result.segments.length, 'segment')}.`);
  shown = new Result(result, status, changed);
  shown.presence.look(document.querySelector('#looks input:checked').value);
  const frame = frameOfAddress();
  if (frame !== null) shown.clock.seek(frame);
  shown.clock.listen(remember);
  shown.presence.enter(result.id, viewer);
  changed();
}

/** Whether the result on screen may be left: open edits are kept first. */
async function leave() {
  shown?.clock.toggle(false);
  if (!shown?.editor.saving.open) return true;
  return shown.editor.saving.flush().then(() => true, () => confirm('Your last edits could not be saved. Leave all the same?'));
}

/** What the address asks for. */
async function route() {
  const id = resultOfAddress();
  if (id && id === onScreen()?.document.id) return;
  if (!(await leave())) return history.pushState(null, '', `/view/${shown.document.id}#frame=${shown.clock.frame}`);
  if (!id) return start();
  const signal = wait('');
  try { await follow(id, signal); } catch (problem) { refuse(problem, '', route); }
}

function start() {
  begin();
  $('subject').textContent = '';
  face('start');
  shown?.close();
  shown = null;
  showRecent(openAnimation);
}

/** Wire every control of the result. Answers a function to call whenever what is shown has changed. */
function wire() {
  playback(onScreen);
  view(onScreen);
  const showTab = tabs($('tabs'));
  segmentList();
  revisionList();
  reviewTools(() => { showTab('tab-review'); return onScreen()?.review; });
  keyboard(onScreen, help());
  const editor = () => onScreen()?.editor;
  const open = (number, dropping) => openRevision(shown, number, dropping);
  const showEdits = editBar(editor, { loadTheirs: () => open(editor().saving.theirs, true) });
  const showLinks = downloads(() => {
    const { saving } = editor();
    return { id: shown.document.id, name: shown.status.name, revision: saving.shown, dirty: saving.open, keep: () => saving.flush() };
  });
  addEventListener('beforeunload', (event) => { if (editor()?.saving.open) event.preventDefault(); });
  addEventListener('visibilitychange', () => { if (document.hidden && editor()?.saving.kind === 'waiting') editor().saving.flush().catch(() => {}); });
  let listed = '';
  return () => {
    if (!editor()) return;
    showEdits();
    showLinks();
    const { saving } = editor();
    const state = `${shown.document.id} ${saving.shown} ${saving.newest}`;
    if (state === listed) return;
    listed = state;
    showRevisions(shown.document.id, saving.shown, open);
    if (location.search && saving.shown === saving.newest) history.replaceState(null, '', location.pathname + location.hash);
  };
}

const onScreen = () => (document.body.dataset.view === 'result' ? shown : null);
const changed = wire();
controls({ recut: (changes) => recut(shown, changes, begin()), current: () => shown.document });
acceptFiles(openFiles);
addEventListener('popstate', route);
addEventListener('hashchange', () => { const frame = frameOfAddress(); if (frame !== null) shown?.clock.seek(frame); });
offerMethods();
route();
