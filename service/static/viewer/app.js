// The page: what leads from one of its views to another, and every control of a result, wired once.

import { showView, frameInAddress, showProblem, rememberFrame, resultInAddress, revisionInAddress } from './views.js';
import * as api from './service/api.js';
import { addSegmentationForm, showFormNote, offerMethods, resegment } from './panels/segmentation_form.js';
import { $, announce } from './dom.js';
import { resetProgress, showStage, showStatus } from './start/progress.js';
import { showRecent } from './start/recent_animations.js';
import { Result } from './result.js';
import { takeSummary, count } from './number_format.js';
import { acceptFiles } from './start/file_drop.js';
import { waitUntilDone } from './service/job_status.js';
import { addEditToolbar } from './editing/edit_toolbar.js';
import { addKeyboard } from './keyboard.js';
import { addReviewTools } from './panels/cut_review.js';
import { addExportMenu } from './panels/export_menu.js';
import { openRevision, addRevisionList, showRevisions } from './panels/revision_list.js';
import { addSegmentList } from './panels/segment_list.js';
import { addTabs } from './roving_focus.js';
import { addPlayerControls, addViewControls } from './timeline/navigation.js';

let shown = null; // the Result on screen
let task = new AbortController(); // the current task; a newer one ends it

function begin() {
  task.abort();
  task = new AbortController();
  return task.signal;
}

/** Show the waiting view. Answers the signal that ends the wait. `cancel()` is what the button does beside leaving. */
function wait(name, cancel = async () => {}) {
  const signal = begin();
  $('subject').textContent = '';
  resetProgress(name);
  showView('waiting', name);
  onCancel(cancel);
  return signal;
}

function onCancel(cancel) {
  $('waiting-cancel').onclick = () => cancel().finally(() => { history.pushState(null, '', '/'); route(); });
}

/** Upload files, have them segmented, show the result. */
async function openFiles(files) {
  if (!(await leave())) return;
  const { name } = files[0];
  const signal = wait(name);
  try {
    showStage('upload', 0);
    const animation = await api.upload(files, (share) => showStage('upload', share), signal);
    await openSegmentation(await api.segment(animation.id), signal);
  } catch (problem) { showProblem(problem, name, () => openFiles(files)); }
}

/** Open an animation of before: its newest segmentation that is done or on its way, else a new one. */
async function openAnimation(animation) {
  const { id, name } = animation;
  const signal = wait(name);
  try {
    const { segmentations } = await api.segmentationsOf(id);
    const being = (...states) => segmentations.find(({ status }) => states.includes(status));
    await openSegmentation(being('done') || being('queued', 'running') || await api.segment(id), signal);
  } catch (problem) { showProblem(problem, name, () => openAnimation(animation)); }
}

async function openSegmentation({ id }, signal) {
  if (signal.aborted) return;
  history.pushState(null, '', `/view/${id}`);
  await follow(id, signal);
}

/** Wait until a segmentation is done, then show it. */
async function follow(id, signal) {
  const status = await waitUntilDone(id, (now) => {
    if (now.status === 'running') import('./figure/scene.js'); // needed soon: fetched while we wait
    if (now.name) $('waiting-name').textContent = now.name;
    onCancel(now.status === 'done' ? async () => {} : () => api.cancel(id).catch(() => {})); // to cancel a finished segmentation would delete it
    showStatus(now);
  }, signal);
  const viewer = api.viewer(id); // fetched beside the result, as the figure takes longest
  viewer.catch(() => {}); // the figure panel shows the problem
  const result = await api.result(id, revisionInAddress() ?? status.revision);
  if (!signal.aborted) show(result, status, viewer);
}

function show(result, status, viewer) {
  shown?.close();
  showFormNote('');
  showView('result', status.name);
  $('subject').textContent = [status.name, takeSummary(result)].filter(Boolean).join(' · ');
  $('result-title').textContent = status.name;
  announce(`${status.name}: ${count(result.motions, 'motion')} in ${count(result.segments.length, 'segment')}.`);
  shown = new Result(result, status, changed);
  shown.figurePanel.colourBy(document.querySelector('#looks input:checked').value);
  const frame = frameInAddress();
  if (frame !== null) shown.playhead.seek(frame);
  shown.playhead.listen(rememberFrame);
  shown.figurePanel.open(result.id, viewer);
  changed();
}

/** Whether the page may leave the result on screen: open edits are saved first. */
async function leave() {
  shown?.playhead.toggle(false);
  if (!shown?.editor.saving.open) return true;
  return shown.editor.saving.flush().then(() => true, () => confirm('The service could not save your last edits. Leave anyway?'));
}

/** Show what the address asks for. */
async function route() {
  const id = resultInAddress();
  if (id && id === onScreen()?.document.id) return;
  if (!(await leave())) return history.pushState(null, '', `/view/${shown.document.id}#frame=${shown.playhead.frame}`);
  if (!id) return start();
  const signal = wait('');
  try { await follow(id, signal); } catch (problem) { showProblem(problem, '', route); }
}

function start() {
  begin();
  $('subject').textContent = '';
  showView('start');
  shown?.close();
  shown = null;
  showRecent(openAnimation);
}

/** Wire every control of the result. Answers a function to call whenever what is shown has changed. */
function wire() {
  addPlayerControls(onScreen);
  addViewControls(onScreen);
  const showTab = addTabs($('tabs'));
  addSegmentList();
  addRevisionList();
  addReviewTools(() => { showTab('tab-review'); return onScreen()?.review; });
  addKeyboard(onScreen);
  const editor = () => onScreen()?.editor;
  const open = (number, dropping) => openRevision(shown, number, dropping);
  const showEdits = addEditToolbar(editor, { loadTheirs: () => open(editor().saving.theirs, true) });
  const showLinks = addExportMenu(() => {
    if (!editor()) return null;
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
addSegmentationForm({ resegment: (changes) => resegment(shown, changes, begin()), current: () => shown.document });
acceptFiles(openFiles);
addEventListener('popstate', route);
addEventListener('hashchange', () => { const frame = frameInAddress(); if (frame !== null) shown?.playhead.seek(frame); });
offerMethods();
route();
