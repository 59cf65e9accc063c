// All segments of one motion side by side, each from its beginning to its end in the same time: as pictures that turn over in step.

import { $, make } from '../dom.js';
import { count, duration } from '../number_format.js';

const MOST = 12; // segments that are shown
const PICTURES = 20; // of each
const LONGEST = 6; // seconds of a round
const SHORTEST = 0.6;

const stillness = matchMedia('(prefers-reduced-motion: reduce)');

let tiles = [];
let playing = false;
let round = 1;

/** Wire the dialog once. */
export function addSideBySide() {
  $('together-play').addEventListener('click', () => { playing = !playing; run(); });
  $('together-share').addEventListener('input', ({ target }) => { playing = false; run(); turnTo(Number(target.value)); });
  $('together-close').addEventListener('click', () => $('together').close());
  $('together').addEventListener('close', () => { tiles = []; playing = false; });
}

/** Show the segments of a motion, the most typical of each take first. */
export function showSideBySide(collection, motion, pictures) {
  const all = segmentsOf(collection, motion);
  const chosen = all.slice(0, MOST);
  $('together-title').textContent = `${motion.name}, side by side`;
  $('together-note').textContent = `${chosen.length < all.length ? `${chosen.length} of ${count(all.length, 'segment')}` : count(all.length, 'segment')}. Each goes from its beginning to its end in the same time, by ${PICTURES} pictures.`;
  tiles = chosen.map(({ take, segment }) => tile(take, segment, pictures));
  $('together-tiles').replaceChildren(...tiles.map(({ item }) => item));
  const { start_seconds: begin, end_seconds: end } = motion.exemplar;
  round = Math.min(LONGEST, Math.max(SHORTEST, end - begin));
  playing = !stillness.matches;
  $('together-share').value = 0;
  $('together').showModal();
  run();
}

/** The segments of a motion in the takes that are loaded: the most typical of each take, then the others. */
function segmentsOf(collection, { id }) {
  const typical = [], others = [];
  for (const take of collection.labelled) {
    const share = take.motions.find(({ motion }) => motion === id);
    for (const segment of take.segments) if (segment.motion === id) (segment.start === share?.start ? typical : others).push({ take, segment });
  }
  return [...typical, ...others];
}

function tile(take, { start, end, start_seconds: from, end_seconds: to }, pictures) {
  const canvas = make('canvas', { width: 192, height: 144, role: 'img', 'aria-label': `${take.name}, ${from.toFixed(1)} to ${to.toFixed(1)} seconds` });
  const note = make('span', { className: 'faint' }, 'Loading …');
  const item = make('li', {}, canvas, make('strong', { title: take.name }, take.name), note);
  const shown = { item, canvas, pictures: [] };
  const frames = Array.from({ length: PICTURES }, (_, place) => Math.floor(start + (place / PICTURES) * (end - start)));
  pictures.of(take.segmentation, frames).then((drawn) => {
    shown.pictures = drawn;
    note.textContent = `${from.toFixed(1)} s, ${duration(to - from)} long`;
    canvas.dataset.drawn = 'yes';
    turnTo(Number($('together-share').value));
  }, () => { note.textContent = 'no figure'; });
  return shown;
}

function turnTo(share) {
  for (const { canvas, pictures } of tiles) {
    if (!pictures.length) continue;
    const context = canvas.getContext('2d');
    context.clearRect(0, 0, canvas.width, canvas.height);
    context.drawImage(pictures[Math.min(pictures.length - 1, Math.floor(share * pictures.length))], 0, 0);
  }
}

let running = false;

function run() {
  $('together-play').textContent = playing ? 'Pause' : 'Play';
  if (running || !playing) return;
  running = true;
  let last = performance.now();
  const step = (now) => {
    running = playing;
    if (!playing) return;
    const share = (Number($('together-share').value) + (now - last) / 1000 / round) % 1;
    last = now;
    $('together-share').value = share;
    turnTo(share);
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
