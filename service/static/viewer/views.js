// The four views of the page (start, waiting, refused, result), and what the address says of the one that is shown.

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
  if (!(problem instanceof Problem)) console.error(problem);
  const { pointer, parameter, frame, code, status } = problem.document || {};
  $('refused-detail').textContent = problem instanceof Problem ? problem.message : 'The page has a fault. The console of the browser says where.';
  $('refused-where').textContent = [name, code, pointer, parameter, frame !== undefined && `frame ${frame}`].filter(Boolean).join(' · ');
  $('refused-again').hidden = code !== 'unreachable' && !(status >= 500);
  $('refused-again').onclick = again;
  showView('refused', 'Problem');
}

const REST = 250; // ms that the playhead rests before its frame goes into the address: browsers refuse sixty changes a second

export const resultInAddress = () => /^\/view\/([^/]+)$/.exec(location.pathname)?.[1];
export const revisionInAddress = () => numberAfter(location.search, /[?&]revision=(\d+)/);
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
