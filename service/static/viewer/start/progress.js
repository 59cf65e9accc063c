// The waiting view: each stage of a segmentation as it comes, ticked when it is over.

import { $, make } from '../dom.js';
import { count } from '../number_format.js';

let stages = [];

export function resetProgress(name) {
  stages = [];
  $('stages').replaceChildren();
  $('waiting-name').textContent = name || 'Working';
  $('waiting-note').textContent = '';
  $('waiting-bar').removeAttribute('value');
}

/** Show a stage, and how much of it is done (null where nobody knows). */
export function showStage(stage, fraction = null, note = fraction === null ? '' : `${Math.round(100 * fraction)} %`) {
  const words = stageText(stage);
  if (words && stages.at(-1) !== words) {
    stages.push(words);
    $('stages').querySelector('[aria-current]')?.removeAttribute('aria-current');
    $('stages').append(make('li', { 'aria-current': 'step' }, words));
  }
  const bar = $('waiting-bar');
  if (fraction === null) bar.removeAttribute('value'); else bar.value = fraction;
  $('waiting-note').textContent = note;
}

/** Say that the service does not answer, and that the page tries again. */
export const showPause = () => { $('waiting-note').textContent = 'The service does not answer. The page tries again.'; };

/** The same for a status document of the service. */
export function showStatus(status) {
  const { stage, fraction } = status.progress || {};
  if (status.status === 'queued') {
    const ahead = status.position || 0;
    showStage('queued', null, ahead ? `${count(ahead, 'job')} before this one` : '');
  } else if (status.status === 'running') showStage(stage || 'read', fraction ?? null);
}

/** Those of the page itself, the worker's and the method's. */
export const STAGES = {
  upload: 'Sending the file',
  queued: 'Waiting for a free worker',
  read: 'Reading the file',
  'rest shape': 'Measuring the figure at rest',
  sample: 'Sampling the take',
  strain: 'Measuring the strain of the surface',
  energy: 'Computing the energy curve',
  'key-frames': 'Choosing the key-frames',
  cut: 'Finding the motions',
  figure: 'Preparing the figure',
  poses: 'Comparing the poses of all takes',
  signatures: 'Describing the segments of all takes',
  linkage: 'Finding the motions of all takes',
  'further takes': 'Labelling further takes',
};

/** A stage in words. A stage this page has not heard of is shown under its own name. */
export const stageText = (stage) => STAGES[stage] || (stage ? stage[0].toUpperCase() + stage.slice(1).replaceAll('-', ' ') : '');
