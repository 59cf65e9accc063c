// The views of the page (start, batch, collection, waiting, refused, result), and what the address says of the one that is shown.

import { Problem } from './service/api.js';
import { $ } from './dom.js';

/** Show a view. */
export function showView(name, title = '') {
  document.body.dataset.view = name;
  document.title = title ? `${title} · Caesura` : 'Caesura';
}

/** Show a problem. `again()` tries once more; it is offered if the problem may pass. */
export function showProblem(problem, name, again) {
  if (problem.name === 'AbortError') return;
  const { code, status } = problem.document || {};
  $('refused-detail').textContent = sentenceOf(problem);
  $('refused-where').textContent = placeOf(problem, name);
  $('refused-again').hidden = code !== 'unreachable' && !(status >= 500);
  $('refused-again').onclick = again;
  showView('refused', 'Problem');
}

/** The same over the result that stays on screen. */
export function showRefusal(problem, name) {
  $('refusal-detail').textContent = sentenceOf(problem);
  $('refusal-where').textContent = placeOf(problem, name);
  $('refusal').showModal();
}

function sentenceOf(problem) {
  if (problem instanceof Problem) return problem.message;
  console.error(problem);
  return 'The page has a fault. The console of the browser says where.';
}

function placeOf({ document }, name) {
  const { pointer, parameter, frame, code } = document || {};
  return [name, code, pointer, parameter, frame !== undefined && `frame ${frame}`].filter(Boolean).join(' · ');
}

const REST = 250; // ms that the playhead rests before its frame goes into the address: browsers refuse sixty changes a second

export const resultInAddress = () => /^\/view\/([^/]+)$/.exec(location.pathname)?.[1];
export const collectionInAddress = () => /^\/collection\/([^/]+)$/.exec(location.pathname)?.[1];
export const batchInAddress = () => location.hash === '#batch';
export const revisionInAddress = () => numberAfter(location.search, /[?&]revision=(\d+)/);
export const lookOnly = () => /[?&]look=1(&|$)/.test(location.search);
export const frameInAddress = () => numberAfter(location.hash, /[#&]frame=(\d+)/);

function numberAfter(text, pattern) {
  const match = pattern.exec(text);
  return match ? Number(match[1]) : null;
}

let resting;

/** Keep the frame in the address, so that a link opens there. */
export function rememberFrame(playhead) {
  clearTimeout(resting);
  if (playhead.playing) return;
  resting = setTimeout(() => {
    if (document.body.dataset.view === 'result') history.replaceState(null, '', `${location.pathname}${location.search}#frame=${playhead.frame}`);
  }, REST);
}
