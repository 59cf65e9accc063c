// What is done on the way to a result, in words.

/** Those of the page itself, the worker's and the method's. */
export const STAGES = {
  upload: 'Sending',
  queued: 'Waiting for a free worker',
  read: 'Reading the file',
  'rest shape': 'Measuring the figure at rest',
  sample: 'Looking through the take',
  strain: 'Measuring how the surface strains',
  energy: 'Joining strain over time',
  'key-frames': 'Looking at the key-frames',
  cut: 'Finding the motions',
  figure: 'Preparing the figure',
};

/** A stage in words. A stage this page has not heard of is shown under its own name. */
export const stageInWords = (stage) => STAGES[stage] || (stage ? stage[0].toUpperCase() + stage.slice(1).replaceAll('-', ' ') : '');
