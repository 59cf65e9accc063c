// The page: what leads from one of its views to another. The code of a view is fetched when the view is first wanted.

import * as api from './service/api.js';
import { count } from './number_format.js';
import { acceptFiles } from './start/file_drop.js';
import { Opening } from './start/opening.js';
import { batchInAddress, collectionInAddress, frameInAddress, resultInAddress, showProblem, showRefusal, showView } from './views.js';

let results = null; // the ResultPage, once its code is here
let collection = null; // the CollectionView, likewise

const goTo = (address) => { history.pushState(null, '', address); route(); };

const resultPage = lazily(async () => {
  const { ResultPage } = await import('./result_page.js');
  results = new ResultPage({ goTo, leave, clear, opening, startBatch });
});
const collectionView = lazily(async () => {
  const { CollectionView } = await import('./collection/collection_view.js');
  collection = new CollectionView(goTo);
});
const batches = lazily(async () => {
  const module = await import('./start/batch.js');
  module.addBatch({ open: (id) => goTo(`/view/${id}`), together: makeCollection });
  return module;
});
const startPage = lazily(async () => {
  const { StartPage } = await import('./start/start_page.js');
  return new StartPage({ openFiles, openAnimation: (animation) => opening.animation(animation), goTo });
});
const opening = new Opening({
  prepare: resultPage, show: (...found) => results.show(...found), refuse, leave: () => goTo('/'),
});

/** A function that does `load` the first time that it is called, and again where that failed. */
function lazily(load) {
  let loaded = null;
  return () => {
    loaded ??= load().catch((problem) => { loaded = null; throw problem; });
    return loaded;
  };
}

/** Open what a person gave: the files of one animation, or several animations as a batch. On a collection they are added to it. */
async function openFiles(files) {
  const { groupFiles } = await import('./start/file_groups.js');
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

async function startBatch(title, items) { (await batches()).startBatch(title, items); }

async function makeCollection(animations) {
  const { makeCollection: make } = await import('./collection/collection_view.js');
  goTo(await make(animations));
}

/** Say why there is no result. A result that was on screen before comes back. */
function refuse(problem, name, again) {
  if (!results?.shown || problem.name === 'AbortError') return showProblem(problem, name, again);
  history.pushState(null, '', results.address);
  results.showAgain();
  showRefusal(problem, name);
}

/** Whether the page may leave what is on screen. */
const leave = async () => results?.leave() ?? true;

/** Show what the address asks for. */
async function route() {
  const id = resultInAddress();
  if (id && id === results?.shown?.document.id && document.body.dataset.view === 'result') return;
  if (!(await leave())) return history.pushState(null, '', results.address);
  if (id) { collection?.close(); return opening.address(id, route); }
  const signal = opening.begin();
  clear();
  const wanted = collectionInAddress();
  try {
    if (wanted) await openCollection(wanted, signal);
    else if (!batchInAddress() || !(await batches()).showBatch()) await showStart(signal);
  } catch (problem) { showProblem(problem, '', route); }
}

async function openCollection(id, signal) {
  await collectionView();
  if (!signal.aborted) await collection.open(id);
}

async function showStart(signal) {
  showView('start');
  const page = await startPage();
  if (!signal.aborted) page.show();
  const { requestIdleCallback: whenIdle = setTimeout } = globalThis;
  whenIdle(() => resultPage().catch(() => {})); // wanted next, most likely
}

/** Leave the result, or the collection, for good. */
function clear() {
  collection?.close();
  results?.clear();
}

acceptFiles(openFiles);
addEventListener('popstate', route);
addEventListener('hashchange', () => results?.seek(frameInAddress()));
route();
