// The page: what leads from one of its views to another, and every control of a result, wired once.

import { collectionInAddress, showView, frameInAddress, showProblem, showRefusal, rememberFrame, resultInAddress, lookOnly } from './views.js';
import * as api from './service/api.js';
import { addFormNote, addSegmentationForm, showFormNote, offerMethods, resegment } from './panels/segmentation_form.js';
import { $, announce, make } from './dom.js';
import { Opening } from './start/opening.js';
import { addBatch, BATCH_ADDRESS, showBatch, startBatch } from './start/batch.js';
import { groupFiles } from './start/file_groups.js';
import { addDemonstration, showDemonstration } from './start/demonstration.js';
import { addSamples } from './start/samples.js';
import { CollectionView, makeCollection } from './collection/collection_view.js';
import { addRecent, showRecent } from './start/recent_animations.js';
import { showCollections } from './start/recent_collections.js';
import { Result } from './result_view.js';
import { takeSummary, count } from './number_format.js';
import { acceptFiles } from './start/file_drop.js';
import { addEditToolbar } from './editing/edit_toolbar.js';
import { offerLoop, playLoop } from './editing/segment_loop.js';
import { showEditedResults } from './editing/edited_results.js';
import { addKeyboard } from './keyboard.js';
import { addReviewTools } from './panels/cut_review.js';
import { addExportMenu } from './panels/export_menu.js';
import { addExportPanel } from './panels/export_panel.js';
import { openRevision, addRevisionList, showRevisions } from './panels/revision_list.js';
import { addSegmentList } from './panels/segment_list.js';
import { addSharing, showLookOnly } from './panels/share.js';
import { addLabelTrack } from './labels/label_track.js';
import { addTakeMenu, showTakes } from './panels/take_menu.js';
import { addComparison } from './timeline/comparison.js';
import { addTabs } from './roving_focus.js';
import { addPlayerControls, addViewControls } from './timeline/navigation.js';

let shown = null; // the Result on screen, or the one to go back to

const opening = new Opening({ show, refuse, leave: () => goTo('/') });

const goTo = (address) => { history.pushState(null, '', address); route(); };
const addressOf = ({ document, playhead }) => `/view/${document.id}#frame=${playhead.frame}`;

/** Open what a person gave: the files of one animation, or several animations as a batch. On a collection they are added to it. */
async function openFiles(files) {
  if (document.body.dataset.view === 'collection') return collection.add(await groupFiles(files));
  if (!(await leave())) return;
  const groups = await groupFiles(files);
  if (groups.length < 2) return opening.files(groups[0]);
  clear();
  startBatch(count(groups.length, 'file'), groups.map((group) => ({
    name: group[0].name,
    send: async (onShare) => api.segment((await api.upload(group, onShare)).id),
  })));
}

/** Show a take of the animation on screen, or `all` of them. */
async function openTake(take) {
  const { status, document } = shown;
  if (!(await leave())) return showTakes(status.animation, document.source);
  opening.segmentation(status.animation, status.name, { ...document.parameters, take, motions: 'auto' });
}

function openTakes(takes) {
  const { status: { animation, name }, document: { parameters } } = shown;
  clear();
  startBatch(`${name}, ${count(takes.length, 'take')}`, takes.map(({ index, name: take }) => ({
    name: take, send: () => api.segment(animation, { ...parameters, take: index, motions: 'auto' }),
  })));
}

function show(result, status, viewer) {
  shown?.close();
  showFormNote('');
  showView('result', status.name);
  showLookOnly();
  $('subject').textContent = [status.name, takeSummary(result)].filter(Boolean).join(' · ');
  $('result-title').textContent = status.name;
  announce(`${status.name}: ${count(result.motions, 'motion')} in ${count(result.segments.length, 'segment')}.`);
  shown = new Result(result, status, changed);
  shown.figurePanel.colourBy(document.querySelector('#looks input:checked').value);
  const frame = frameInAddress();
  if (frame !== null) shown.playhead.seek(frame);
  shown.playhead.listen(rememberFrame);
  shown.figurePanel.open(result.id, viewer);
  showTakes(status.animation, result.source);
  changed();
}

/** Say why there is no result. A result that was on screen before comes back. */
function refuse(problem, name, again) {
  if (!shown || problem.name === 'AbortError') return showProblem(problem, name, again);
  history.pushState(null, '', addressOf(shown));
  showResultAgain();
  showRefusal(problem, name);
}

function showResultAgain() {
  showView('result', shown.status.name);
  $('subject').textContent = [shown.status.name, takeSummary(shown.document)].filter(Boolean).join(' · ');
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
  if (id && id === shown?.document.id && document.body.dataset.view === 'result') return;
  if (!(await leave())) return history.pushState(null, '', addressOf(shown));
  if (id) { collection.close(); return opening.address(id, route); }
  opening.begin();
  clear();
  const wanted = collectionInAddress();
  if (wanted) return collection.open(wanted).catch((problem) => showProblem(problem, '', route));
  if (location.hash === new URL(BATCH_ADDRESS, location).hash && showBatch()) return;
  showView('start');
  showRecent();
  showCollections((chosen) => goTo(`/collection/${chosen}`));
  showDemonstration(true);
}

/** Leave the result, or the collection, for good. */
function clear() {
  collection.close();
  shown?.close();
  shown = null;
  $('subject').textContent = '';
  for (const id of ['takes', 'take-place']) $(id).hidden = true;
}

/** Wire every control of the result. Answers a function to call whenever what is shown has changed. */
function wire() {
  addPlayerControls(onScreen);
  addViewControls(onScreen);
  addComparison(onScreen);
  addLabelTrack(() => onScreen()?.labelTrack);
  addSharing(() => ({ id: shown.document.id, revision: shown.editor.saving.shown, frame: shown.playhead.frame }));
  const showTab = addTabs($('tabs'));
  addSegmentList(onScreen);
  addRevisionList();
  addReviewTools(() => { showTab('tab-review'); return onScreen()?.review; });
  addTakeMenu({ open: openTake, batch: openTakes });
  addKeyboard(onScreen);
  const editor = () => onScreen()?.editor;
  const open = (number, dropping) => openRevision(shown, number, dropping);
  const showEdits = addEditToolbar(editor, { loadTheirs: () => open(editor().saving.theirs, true) });
  $('play-loop').addEventListener('click', () => playLoop(shown));
  const exported = () => {
    if (!editor()) return null;
    const { saving, segments, affected } = editor();
    return { id: shown.document.id, revision: saving.shown, dirty: saving.open, keep: () => saving.flush(), segments, affected };
  };
  const showLinks = addExportMenu(exported);
  addExportPanel(exported);
  addEventListener('beforeunload', (event) => { if (editor()?.saving.open) event.preventDefault(); });
  addEventListener('visibilitychange', () => { if (document.hidden && editor()?.saving.kind === 'waiting') editor().saving.flush().catch(() => {}); });
  let listed = '';
  return () => {
    if (!editor()) return;
    showEdits();
    offerLoop(shown);
    showLinks();
    const { saving } = editor();
    const state = `${shown.document.id} ${saving.shown} ${saving.newest}`;
    if (state === listed) return;
    listed = state;
    showRevisions(shown.document.id, saving.shown, open);
    showEditedResults(shown.status.animation, shown.document, { open: (id) => goTo(`/view/${id}`), offer: offerEdits });
    if (location.search && !lookOnly() && saving.shown === saving.newest) history.replaceState(null, '', location.pathname + location.hash);
  };
}

/** Say that the same take is edited elsewhere, and offer to go there. */
function offerEdits({ id, motions }) {
  addFormNote(`You have edited this take with ${count(motions, 'motion')} before. `,
    make('button', { type: 'button', onclick: () => goTo(`/view/${id}`) }, 'Show the edits'));
}

const collection = new CollectionView(goTo);
const onScreen = () => (document.body.dataset.view === 'result' ? shown : null);
const changed = wire();
addSegmentationForm({ resegment: (changes) => resegment(shown, changes, opening.begin()), current: () => shown });
addRecent((animation) => opening.animation(animation));
addSamples(openFiles);
addDemonstration();
addBatch({ open: (id) => goTo(`/view/${id}`), together: async (animations) => goTo(await makeCollection(animations)) });
acceptFiles(openFiles);
addEventListener('popstate', route);
addEventListener('hashchange', () => { const frame = frameInAddress(); if (frame !== null) shown?.playhead.seek(frame); });
offerMethods();
route();
