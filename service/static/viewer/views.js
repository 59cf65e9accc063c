// The four faces of the page: start, waiting, refused and result. The style sheet shows the one that is set.

import { Problem } from './service/api.js';
import { $ } from './dom.js';

/** Show one of them. */
export function face(name, title = '') {
  document.body.dataset.view = name;
  document.title = title ? `${title} · Caesura` : 'Caesura';
}

/** Say what went wrong, and with what. `again()` tries it once more, where what went wrong may pass. */
export function refuse(problem, name, again) {
  if (problem.name === 'AbortError') return;
  if (!(problem instanceof Problem)) console.error(problem);
  const { pointer, parameter, frame, code, status } = problem.document || {};
  $('refused-detail').textContent = problem instanceof Problem ? problem.message : 'The page itself failed; the console says where.';
  $('refused-where').textContent = [name, code, pointer, parameter, frame !== undefined && `frame ${frame}`].filter(Boolean).join(' · ');
  $('refused-again').hidden = code !== 'unreachable' && !(status >= 500);
  $('refused-again').onclick = again;
  face('refused', 'Problem');
}
