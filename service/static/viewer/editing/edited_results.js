// Results of the same take that a person has edited: found again from any other result of it.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { ago, count } from '../number_format.js';
import { setTabStop } from '../roving_focus.js';

/** Every other result of the take of `document` that has revisions, newest first; those cut as it is come first. */
async function editedResults(animationId, document) {
  const { segmentations } = await api.segmentationsOf(animationId);
  const { take, method } = document.parameters;
  const likeness = ({ motions, parameters }) => 2 * Number(parameters.method === method) + Number(motions === document.motions);
  return segmentations.filter(({ id, revision, parameters }) => revision && id !== document.id && parameters.take === take)
    .toSorted((one, other) => likeness(other) - likeness(one));
}

let asked = 0;

/**
 * List them below the revisions. Where `document` is as computed and another of as many motions is edited, `offer(result)` is
 * called with it. `open(id)` is called for the one chosen.
 */
export async function showEditedResults(animationId, document, { open, offer }) {
  const turn = ++asked;
  const found = await editedResults(animationId, document).catch(() => []);
  if (turn !== asked) return;
  $('edited-results').hidden = !found.length;
  $('edited-list').replaceChildren(...found.map(({ id, motions, revision, created, parameters }) => make('li', {},
    make('button', { type: 'button', className: 'revision', tabIndex: -1, onclick: () => open(id) },
      make('span', { className: 'name' }, `${count(motions, 'motion')}, ${parameters.motions === 'auto' ? 'found' : 'as asked for'}`),
      make('span', { className: 'ago' }, ago(created)),
      make('span', { className: 'note-line' }, `${parameters.method}, revision ${revision}`)))));
  setTabStop($('edited-list'), 'button');
  const same = found.find(({ motions, parameters }) => motions === document.motions && parameters.method === document.method);
  if (same && !document.revision) offer(same);
}
