// What one gets, on the first screen: a figure that moves, its take in colours, and the clips by name, in a short loop.

import { $, make, nextPaint } from '../dom.js';
import { segmentIndexAt } from '../editing/segment_edits.js';
import { probeRenderer, isSoftware } from '../figure/renderer_probe.js';
import { motionColour, writeTag } from '../palette.js';
import { sampleBytes, sampleIndex } from './samples.js';

const SHORTEST = 30; // ms between two pictures
const SHORTEST_BY_SOFTWARE = 120; // that draws them with all processors, while somebody may have a take cut
const REST = 2; // so many times as long as a picture takes to draw passes until the next, at least

const stillness = matchMedia('(prefers-reduced-motion: reduce)');

const asked = () => document.body.dataset.view === 'start';
let paused = stillness.matches;
let stage = null; // what is drawn with, once it is loaded: `{ scene, shortest, sample }`
let position = 0;

/** Show the demonstration; on other views nothing is drawn. */
export async function showDemonstration() {
  const { demonstration: sample } = await sampleIndex() ?? {};
  $('demonstration').hidden = !sample;
  if (!sample || stage) return run();
  list(sample);
  await nextPaint();
  await new Promise((done) => setTimeout(done, 200)); // a person who opens something at once waits for no figure
  if (!asked() || stage) return;
  stage = { sample, scene: null };
  Object.assign(stage, await load(sample).catch(() => null)); // without WebGL the strip and the clips say it
  document.body.classList.toggle('no-demonstration', !stage.scene);
  run();
}

async function load(sample) {
  const [{ FigureScene }, model, renderer] = await Promise.all([import('../figure/scene.js'), sampleBytes(sample), probeRenderer()]);
  const software = isSoftware(renderer);
  const scene = new FigureScene($('demo-figure'), software, { turns: false });
  const viewer = { kind: 'gltf', skeleton: false, start_seconds: 0, frame_rate: sample.frame_rate };
  await scene.show(viewer, { model, strain: null }, new AbortController().signal);
  $('demo-figure').dataset.shown = 'gltf';
  return { scene, shortest: software ? SHORTEST_BY_SOFTWARE : SHORTEST };
}

/** Write the segments below the figure, as a strip and as the clips they become. */
function list({ segments, frames, frame_rate: rate }) {
  const numbers = {};
  $('demo-strip').append(...segments.map((segment) => {
    const box = make('span', {}, segment.name);
    writeTag(box, segment);
    box.style.flexGrow = segment.end - segment.start;
    return box;
  }));
  $('demo-clips').replaceChildren(...segments.map(({ name, motion, start, end }) => {
    numbers[name] = (numbers[name] ?? 0) + 1;
    const swatch = make('i', { className: 'swatch', 'aria-hidden': 'true' });
    swatch.style.backgroundColor = motionColour(motion);
    return make('li', {}, swatch, `${name}_0${numbers[name]}`, make('span', { className: 'faint' }, `${((end - start) / rate).toFixed(1)} s`));
  }));
  show(segments, frames);
}

function show(segments, frames) {
  const at = segmentIndexAt(segments, position);
  $('demo-head').style.left = `${(100 * position) / frames}%`;
  [...$('demo-clips').children].forEach((clip, index) => clip.classList.toggle('now', index === at));
  return segments[at];
}

/** Wire the button once: whoever wants no motion stops it. */
export function addDemonstration() {
  $('demo-play').addEventListener('click', () => { paused = !paused; run(); });
  document.addEventListener('visibilitychange', run);
}

let running = false;

function run() {
  $('demo-play').textContent = paused ? 'Play' : 'Pause';
  if (!stage?.scene || running) return;
  running = true;
  let last = performance.now();
  const step = (now) => {
    const { scene, shortest, sample: { segments, frames, frame_rate: rate } } = stage;
    running = asked() && !paused && !document.hidden;
    position = (position + (Math.min(200, now - last) / 1000) * rate) % frames;
    last = now;
    const { motion } = show(segments, frames);
    const cost = scene.drawNow([{ position, colouring: motionColour(motion) }]);
    if (running) setTimeout(() => requestAnimationFrame(step), Math.max(shortest, REST * cost) - 16);
  };
  requestAnimationFrame(step);
}
