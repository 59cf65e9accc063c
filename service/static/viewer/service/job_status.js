// The status of a segmentation: live by server-sent events, by long polling if those do not come through.

import * as api from './api.js';
import { untilAnswered } from './retry.js';

const OVER = new Set(['done', 'failed', 'cancelled']);

/**
 * The status document once it is done. `onStatus` gets every one on the way; `onPause(problem)` is called while the service does
 * not answer and the page tries again. Throws the problem it failed with.
 */
export async function waitUntilDone(id, onStatus, signal, onPause) {
  const ask = (wait) => untilAnswered(() => api.status(id, wait, signal), signal, onPause);
  let status = await ask(0);
  onStatus(status);
  if (!OVER.has(status.status)) status = await followEvents(id, onStatus, signal).catch((e) => stopOr(e, null));
  while (!status || !OVER.has(status.status)) {
    status = await ask(15);
    onStatus(status);
  }
  if (status.status === 'failed') throw new api.Problem(status.problem || { detail: 'It failed without a reason.' });
  if (status.status === 'cancelled') throw new api.Problem({ code: 'cancelled', detail: 'This segmentation was cancelled.' });
  return status;
}

function stopOr(error, value) {
  if (error.name === 'AbortError') throw error;
  return value;
}

/** Follow the events until the last one; rejects when the stream breaks, and polling takes over. */
function followEvents(id, onStatus, signal) {
  return new Promise((resolve, reject) => {
    const stream = new EventSource(`/v1/segmentations/${id}/events`);
    const end = (settle, value) => { stream.close(); settle(value); };
    const receive = (event) => {
      const status = JSON.parse(event.data);
      onStatus(status);
      if (OVER.has(status.status)) end(resolve, status);
    };
    stream.addEventListener('status', receive);
    stream.addEventListener('deleted', () => end(resolve, { status: 'cancelled' }));
    stream.onerror = () => end(reject, new Error('stream ended'));
    signal?.addEventListener('abort', () => end(reject, new DOMException('cancelled', 'AbortError')));
  });
}
