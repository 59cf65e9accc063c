// Search by example: the ranges of other takes that are like one, the nearest first.

import * as collections from '../service/collections.js';
import { $, make } from '../dom.js';
import { clockTime, count } from '../number_format.js';
import { swatchOf } from '../palette.js';
import { addRovingFocus, setTabStop } from '../roving_focus.js';
import { drawPicture } from './figure_pictures.js';

const WANTED = 20;

let turn = 0; // an older answer that comes later is not shown

/** Wire the list once. */
export const addSimilar = () => addRovingFocus($('similar-rows'), 'button');

/** Search for frames [start, end) of a take, called `what`. `open(take, frame)` is called for a range that a person chooses. */
export async function showSimilar(collection, { animation, start, end }, what, pictures, open) {
  const now = ++turn;
  $('similar-title').textContent = `Like ${what}`;
  $('similar-note').textContent = 'Searching …';
  $('similar-rows').replaceChildren();
  $('similar').showModal();
  try {
    const { status, problem, found } = await collections.search(collection.id, { animation, start, end, limit: WANTED });
    const takes = await Promise.all(found.map((range) => collection.take(range.animation).catch(() => null)));
    if (now !== turn) return;
    $('similar-note').textContent = status === 'failed' ? problem.detail : `${count(found.length, 'range')}, the nearest first. Distance 0 is the same, 1 as unlike as two poses at random.`;
    $('similar-rows').replaceChildren(...found.map((range, place) => takes[place] && make('li', {}, row(collection, range, takes[place], pictures, open))).filter(Boolean));
    setTabStop($('similar-rows'), 'button');
  } catch ({ message }) { if (now === turn) $('similar-note').textContent = message; }
}

function row(collection, range, take, pictures, open) {
  const middle = Math.floor((range.start + range.end) / 2);
  const segment = take.segments.find(({ start, end }) => start <= middle && middle < end);
  const { name, colour, texture } = collection.motion(segment?.motion);
  const canvas = make('canvas', { width: 64, height: 48, 'aria-hidden': 'true' });
  drawPicture(pictures, take.segmentation, middle, canvas);
  return make('button', { type: 'button', className: 'found', tabIndex: -1, onclick: () => { $('similar').close(); open(take, range.start); } }, canvas,
    make('span', { className: 'name' }, take.name), make('span', { className: 'of' }, swatchOf(colour, texture), name),
    make('span', { className: 'from' }, `${clockTime(range.start_seconds)} to ${clockTime(range.end_seconds)}`),
    make('span', { className: 'sure' }, make('span', { className: 'unseen' }, 'distance '), range.distance.toFixed(2)));
}
