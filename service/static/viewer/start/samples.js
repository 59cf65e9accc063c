// Samples to try, which the service has with its page: a click sends one as if a person had chosen the file.

import { $, make } from '../dom.js';
import { duration } from '../number_format.js';
import { segmentStrip } from './segment_strip.js';

const FOLDER = '/static/vendor/samples';

let index = null;

/** The index of the samples: `{ demonstration, samples }`, or null where there are none. */
export function sampleIndex() {
  index ??= fetch(`${FOLDER}/samples.json`).then((answer) => (answer.ok ? answer.json() : null), () => null);
  return index;
}

/** The bytes of a sample. */
export const sampleBytes = async ({ file }) => (await fetch(`${FOLDER}/${file}`)).arrayBuffer();

/** List the samples once; `open(files)` is called with the one chosen. */
export async function addSamples(open) {
  const { samples = [] } = await sampleIndex() ?? {};
  $('samples').hidden = !samples.length;
  $('sample-cards').replaceChildren(...samples.map((sample) => make('li', { className: 'card' },
    make('button', { type: 'button', className: 'animation sample', onclick: async () => open([new File([await sampleBytes(sample)], sample.file)]) },
      make('span', { className: 'strip-place' }, segmentStrip(sample.segments, sample.frames)),
      make('strong', {}, sample.title),
      make('span', { className: 'facts' }, `${sample.description} · `, make('span', {}, duration(sample.frames / sample.frame_rate)))))));
}
