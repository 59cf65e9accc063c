// All segments of one motion side by side, each as a figure: they stand on one floor, turn together, and move in one rhythm.

import { downloadFigure } from '../figure/download.js';
import { isSoftware, probeRenderer } from '../figure/renderer_probe.js';
import { $, make } from '../dom.js';
import { count, duration } from '../number_format.js';
import { viewerOf } from './figure_pictures.js';
import { segmentsOf, sharesOf, withRepeats } from './rhythm.js';

const MOST = 12; // figures at once
const MOST_ROWS = 3;
const WIDTH = 140; // pixels that one figure needs
const LONGEST = 60; // seconds of a round
const SHORTEST = 0.6;

const stillness = matchMedia('(prefers-reduced-motion: reduce)');

let scene = null; // one for the page: a browser gives out few WebGL contexts
let shown = null; // the motion on screen: its segments, the first of those that are seen, and those that move
let playing = false;
let running = false;

/** Wire the dialog once. */
export function addSideBySide() {
  $('together-play').addEventListener('click', () => { playing = !playing; run(); });
  $('together-share').addEventListener('input', () => { playing = false; run(); pose(); });
  $('together-earlier').addEventListener('click', () => showPage(shown.first - shown.most));
  $('together-later').addEventListener('click', () => showPage(shown.first + shown.most));
  $('together-close').addEventListener('click', () => $('together').close());
  $('together').addEventListener('close', leave);
}

/** Show the segments of a motion, as many at once as there is room for. */
export function showSideBySide(collection, motion) {
  leave();
  $('together-title').textContent = `${motion.name}, side by side`;
  $('together-share').value = 0;
  $('together').showModal();
  const columns = Math.max(2, Math.min(MOST / 2, Math.floor($('together-stage').clientWidth / WIDTH)));
  shown = { segments: segmentsOf(collection, motion), first: 0, columns, most: Math.min(MOST, columns * MOST_ROWS), closing: new AbortController(), moving: [] };
  playing = !stillness.matches;
  showPage(0);
}

function leave() {
  shown?.closing.abort();
  scene?.clear();
  shown = null;
  playing = false;
  delete $('together-figures').dataset.shown;
}

/** Show the segments from number `first` on. */
async function showPage(first) {
  shown.closing.abort();
  shown.closing = new AbortController();
  const { signal } = shown.closing;
  Object.assign(shown, { first, moving: [] });
  const { segments, most } = shown;
  const items = segments.slice(first, first + most);
  const few = segments.length <= most ? count(segments.length, 'segment') : `${first + 1} to ${first + items.length} of ${count(segments.length, 'segment')}`;
  $('together-earlier').hidden = $('together-later').hidden = segments.length <= most;
  $('together-earlier').disabled = first === 0;
  $('together-later').disabled = first + most >= segments.length;
  $('together-tiles').replaceChildren();
  delete $('together-figures').dataset.shown;
  say(`${few}. Loading the figures …`);
  try {
    const missing = await showFigures(items, signal);
    if (signal.aborted) return;
    say(`${few}, each as far into the motion as the first.${missing ? ` ${count(missing, 'figure')} cannot be shown.` : ''}`);
    run();
  } catch ({ message }) {
    if (!signal.aborted) say(`The page cannot show the figures: ${message}`);
  }
}

/** Load the figures of segments and show those that there are; answers how many there are not. */
async function showFigures(items, signal) {
  const [{ FigureScene }, renderer, repeated, members] = await Promise.all([
    import('../figure/scene.js'), probeRenderer(), withRepeats(items), figuresOf(items, signal)]);
  signal.throwIfAborted();
  scene ||= new FigureScene($('together-figures'), isSoftware(renderer));
  const present = members.flatMap((member, place) => (member ? [{ member, ...repeated[place] }] : []));
  if (!present.length) throw new Error('none of them is kept.');
  scene.columns = Math.min(shown.columns, present.length);
  $('together-tiles').style.setProperty('--columns', scene.columns);
  $('together-tiles').replaceChildren(...present.map(label));
  await scene.show({ kind: 'group', members: present.map(({ member }) => member) }, {}, signal);
  signal.throwIfAborted();
  shown.moving = present.map(({ segment }) => segment);
  await pose(0);
  signal.throwIfAborted();
  await pose(); // those in place are compared with the first
  $('together-figures').dataset.shown = present.length;
  return items.length - present.length;
}

/** For each segment its viewer document and files, those of one take once; null where there is no figure. */
function figuresOf(items, signal) {
  const figures = new Map();
  const figure = async (segmentation) => {
    const viewer = await viewerOf(segmentation, signal);
    const files = downloadFigure(viewer, signal);
    await files.model;
    return { viewer, files, take: segmentation };
  };
  for (const { take: { segmentation } } of items) if (!figures.has(segmentation)) figures.set(segmentation, figure(segmentation).catch(() => null));
  return Promise.all(items.map(async ({ take, segment: { start, end } }) => {
    const found = await figures.get(take.segmentation);
    return found && { ...found, start, end };
  }));
}

const label = ({ take, segment: { start_seconds: from, end_seconds: to } }) =>
  make('li', {}, make('strong', { title: take.name }, take.name), make('span', { className: 'faint' }, `${from.toFixed(1)} s, ${duration(to - from)} long`));

const say = (sentence) => { $('together-note').textContent = sentence; };

/** Pose all figures where the slider stands. Answers what must be fetched first. */
function pose(share = Number($('together-share').value)) {
  if (!shown?.moving.length) return null;
  return scene.pose(sharesOf(shown.moving, share).map((into, place) => ({ position: place + into, start: place, colouring: null })));
}

function run() {
  $('together-play').textContent = playing ? 'Pause' : 'Play';
  if (running || !playing) return;
  running = true;
  let last = performance.now();
  const step = (now) => {
    running = playing;
    if (!playing) return;
    const [first] = shown.moving;
    const round = first ? Math.min(LONGEST, Math.max(SHORTEST, first.end_seconds - first.start_seconds)) : Infinity;
    $('together-share').value = (Number($('together-share').value) + (now - last) / 1000 / round) % 1;
    last = now;
    pose();
    requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}
