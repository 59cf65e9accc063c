// Variants of the take on screen: cut another way, or another revision. The figure, the moment and the zoom stay.

import * as api from '../service/api.js';
import { note, reflect } from './segmentation_form.js';
import { count } from '../number_format.js';
import { finished } from '../service/job_status.js';

const SOON = 150; // ms after which a wait is said

/** Cut the take of a result with other parameters, after what is open is kept. */
export async function recut(result, changes, signal) {
  const waiting = setTimeout(() => note('Cutting again …'), SOON);
  try {
    const { saving } = result.editor;
    await saving.flush();
    const { id } = await api.segment(result.status.animation, { ...result.document.parameters, ...changes });
    const status = await finished(id, () => {}, signal);
    const document = await api.result(id, status.revision);
    if (signal.aborted || result.closed) return;
    const left = id !== result.document.id && saving.shown > 0;
    history.pushState(null, '', `/view/${id}${location.hash}`);
    result.show(document, status);
    note(`Now ${count(document.motions, 'motion')} in ${count(document.segments.length, 'segment')}.${left ? ' Your edits are of the cut before: go back to see them.' : ''}`);
  } catch (problem) {
    if (problem.name === 'AbortError' || result.closed) return;
    note(problem.message);
    reflect(result.document);
  } finally { clearTimeout(waiting); }
}

/** Show another revision of a result, after what is open is kept (or, where it cannot be, dropped on purpose). */
export async function openRevision(result, number, dropping = false) {
  const { saving } = result.editor;
  const { id } = result.document;
  try {
    if (!dropping) await saving.flush();
    const newest = dropping ? number : saving.newest;
    const document = await api.result(id, number);
    if (result.closed) return;
    history.replaceState(null, '', `/view/${id}${number === newest ? '' : `?revision=${number}`}${location.hash}`);
    result.show(document, { ...result.status, revision: newest });
  } catch (problem) { note(problem.message); }
}
