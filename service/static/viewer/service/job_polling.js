// Segmentations that are followed together: one request tells of all, for a browser opens few connections at once.

import * as api from './api.js';
import { untilAnswered } from './retry.js';

const EVERY = 700; // ms between two requests
const OVER = new Set(['done', 'failed', 'cancelled']);

const followed = new Map(); // what to call, by the id of the segmentation

/**
 * The status document of a segmentation once it is done. `tell(status)` gets every one on the way, `pause()` is called while the
 * service does not answer. Rejects with the problem it failed with.
 */
export function followJob(id, tell, pause) {
  return new Promise((resolve, reject) => {
    followed.set(id, { tell, pause, resolve, reject });
    if (followed.size === 1) run();
  });
}

async function run() {
  while (followed.size) {
    await new Promise((done) => setTimeout(done, EVERY));
    await untilAnswered(look, undefined, () => { for (const { pause } of followed.values()) pause(); });
  }
}

/** Ask for the newest segmentations, and by itself for each that is not among them. */
async function look() {
  const { segmentations } = await api.segmentations();
  const seen = new Map(segmentations.map((status) => [status.id, status]));
  for (const id of [...followed.keys()]) {
    const status = seen.get(id);
    if (status && !OVER.has(status.status)) followed.get(id).tell(status);
    else await ask(id);
  }
}

async function ask(id) {
  const { tell, resolve, reject } = followed.get(id);
  let status;
  try { status = await api.status(id); } catch (problem) {
    if (problem.document?.status !== 404) throw problem;
    followed.delete(id);
    return reject(problem);
  }
  if (!OVER.has(status.status)) return tell(status);
  followed.delete(id);
  if (status.status === 'done') resolve(status);
  else reject(new api.Problem(status.problem || { code: status.status, detail: 'This segmentation was cancelled.' }));
}
