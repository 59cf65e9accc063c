// Trying again: a service that restarts, or a network that is away, is back after a while.

const LONGEST = 15_000; // ms between two attempts

/** Whether a problem may pass by itself: nobody answered, or the service is not at its best. */
export const mayPass = ({ document }) => document?.code === 'unreachable' || document?.status >= 500;

/** Milliseconds to wait before the attempt after so many that failed. */
export const pauseBefore = (failures) => Math.min(LONGEST, 1000 * 2 ** failures);

/** Do `attempt()` until it answers. `onPause(problem)` is called before every wait; `signal` ends it. */
export async function untilAnswered(attempt, signal, onPause = () => {}) {
  for (let failures = 0; ; failures++) {
    try { return await attempt(); } catch (problem) {
      if (!mayPass(problem)) throw problem;
      onPause(problem);
      await pause(pauseBefore(failures), signal);
    }
  }
}

/** Wait, at most until the browser is online again. */
function pause(milliseconds, signal) {
  return new Promise((resolve, reject) => {
    const end = (settle, value) => { clearTimeout(timer); removeEventListener('online', online); settle(value); };
    const online = () => end(resolve);
    const timer = setTimeout(online, milliseconds);
    addEventListener('online', online);
    signal?.addEventListener('abort', () => end(reject, new DOMException('cancelled', 'AbortError')));
  });
}
