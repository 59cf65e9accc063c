// Frame numbers as the person's editor shows them. Inside and in links a frame counts from 0 and an interval leaves
// out its end; an editor may count from 1 and name the last frame that belongs. The choice is remembered.

import { stored, store } from './local_storage.js';
import { whole } from './number_format.js';

const KEY = 'caesura.frames-from';

let first = stored(KEY) === 1 ? 1 : 0;
const listeners = new Set();

/** 0, or 1 where frames count from 1 and an interval names its last frame. */
export const countsFrom = () => first;

export function countFrom(number) {
  first = number;
  store(KEY, number);
  for (const listener of listeners) listener();
}

/** Call back whenever numbers are shown the other way, until `signal` ends it. */
export function onCounting(listener, signal) {
  listeners.add(listener);
  signal?.addEventListener('abort', () => listeners.delete(listener));
}

/** A frame as a number to show, plain. */
export const numberOf = (frame) => frame + first;

/** A frame, grouped by thousands. */
export const shownFrame = (frame) => whole(frame + first);

/** An interval [start, end): "208–385" without its end, "209–385" with its last frame. */
export const shownInterval = (start, end) => `${whole(start + first)}–${whole(end)}`;

/** The frame a person means by what they typed, or null. */
export function typedFrame(text) {
  const digits = text.replace(/[\s\u202f,]/g, '');
  return /^\d+$/.test(digits) ? Math.max(0, Number(digits) - first) : null;
}
