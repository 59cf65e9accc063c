// Recent animations as cards, newest first: found by their names, renamed and deleted, with more at a click.

import * as api from '../service/api.js';
import { $ } from '../dom.js';
import { askForName } from '../name_dialog.js';
import { animationCard } from './animation_card.js';

const QUIET = 250; // ms after the last letter of a search

let asked = 0; // so that an older answer that comes later is not shown
let open = () => {};
let next = null; // the address of the page after those that are listed

/** Wire the search once. `openAnimation(animation)` is called for the one chosen. */
export function addRecent(openAnimation) {
  open = openAnimation;
  let timer;
  $('recent-search').addEventListener('input', () => {
    clearTimeout(timer);
    timer = setTimeout(showRecent, QUIET);
  });
  $('recent-more').addEventListener('click', showMore);
}

/** List the animations that the search finds. The list stays hidden where there is nothing. */
export async function showRecent() {
  const words = $('recent-search').value.trim();
  const turn = ++asked;
  const answer = await api.animations(words).catch(() => null);
  if (turn !== asked) return;
  $('recent').hidden = !words && !answer?.animations.length;
  $('recent-none').hidden = Boolean(answer?.animations.length);
  $('recent-none').textContent = answer ? `No animation is called “${words}”.` : 'The service does not answer.';
  list(answer, (cards) => $('recent-cards').replaceChildren(...cards));
}

async function showMore() {
  const turn = ++asked;
  const answer = await api.more(next).catch(() => null);
  if (turn === asked && answer) list(answer, (cards) => { $('recent-cards').append(...cards); cards[0]?.querySelector('.animation').focus(); });
}

function list(answer, put) {
  next = answer?.next ?? null;
  $('recent-more').hidden = !next;
  put((answer?.animations ?? []).map((animation) => animationCard(animation, { open, remove: askToDelete, rename })));
}

/** Delete an animation if a person confirms it. */
async function askToDelete(animation, card) {
  if (!confirm(`Delete ${animation.name}, its results and your edits? This cannot be undone.`)) return;
  await api.deleteAnimation(animation.id).then(() => card.remove(), ({ message }) => alert(message));
}

/** Ask for another name; `renamed(animation)` is called with the animation as it is then. */
async function rename(animation, renamed) {
  const name = await askForName({ title: 'Rename the animation', value: animation.name });
  if (name) await api.rename(animation.id, name).then(renamed, ({ message }) => alert(message));
}
