// The takes of a file with several: which one is shown, another by itself, or every one as a batch.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { duration } from '../number_format.js';

const ALL = 'all';
const EVERY = -1; // the number of the take in a result of all takes

let asked = 0;

/** Wire the menu once. `open(take)` shows a take by its number, or `all` one after the other; `batch(takes)` segments each. */
export function addTakeMenu({ open, batch }) {
  $('take').addEventListener('change', ({ target: { value } }) => open(value === ALL ? ALL : Number(value)));
  $('every-take').addEventListener('click', () => batch(takes));
}

let takes = [];

/** Show the takes of an animation, and that the result on screen is of the one that `source` names. Hidden where there is one. */
export async function showTakes(animationId, source) {
  const turn = ++asked;
  for (const id of ['takes', 'take-place']) $(id).hidden = true;
  const animation = await api.animation(animationId).catch(() => null);
  if (turn !== asked || !animation || animation.take_count < 2) return;
  takes = animation.takes;
  const place = takes.findIndex(({ index }) => index === source.take);
  $('take-place').textContent = source.take === EVERY ? `all ${takes.length} takes` : `take ${place + 1} of ${takes.length}`;
  $('take').replaceChildren(
    ...takes.map(({ index, name, duration_seconds: seconds }) => make('option', { value: index }, `${name} · ${duration(seconds)}`)),
    make('option', { value: ALL }, 'All takes, one after the other'));
  $('take').value = source.take === EVERY ? ALL : source.take;
  for (const id of ['takes', 'take-place']) $(id).hidden = false;
}
