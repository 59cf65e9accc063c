// The list of revisions, newest first, down to the computed result. A person can show each, and edit from there.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { ago } from '../number_format.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';
import { showFormNote } from './segmentation_form.js';

let asked = 0;

/** List the revisions of a result and mark the one `shown`. `open(number)` is called for the one chosen. */
export async function showRevisions(id, shown, open) {
  const turn = ++asked;
  const answer = await api.revisions(id).catch(() => null);
  if (turn !== asked) return; // an older answer that came later
  const kept = answer?.revisions || [{ revision: 0, created: null, note: '' }];
  const rows = kept.toReversed().map(({ revision, created, note }) => {
    const row = make('button', { type: 'button', className: 'revision', tabIndex: -1, onclick: () => open(revision) },
      make('span', { className: 'name' }, revision ? `Revision ${revision}` : 'Computed result'),
      make('span', { className: 'ago' }, created ? ago(created) : ''),
      note ? make('span', { className: 'note-line' }, note) : null);
    if (revision === shown) row.setAttribute('aria-current', 'true');
    return make('li', {}, row);
  });
  $('revisions').replaceChildren(...rows);
  setTabStop($('revisions'), 'button');
}

/** Wire the list once. */
export const addRevisionList = () => { for (const id of ['revisions', 'edited-list']) addRovingFocus($(id), 'button'); };

/** Show another revision of a result. Open edits are saved first, or dropped if a person chose so. */
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
  } catch (problem) { showFormNote(problem.message); }
}
