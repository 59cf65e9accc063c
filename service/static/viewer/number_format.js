// Numbers as people read them: lengths of time, counts, and frames counted from 0 or from 1.

import { store, stored } from './local_storage.js';

const GROUPED = new Intl.NumberFormat('en-US');
const JUST = 45; // seconds that are still "just now"
const STEPS = [['minute', 60], ['hour', 3600], ['day', 86400]];
const AGO = new Intl.RelativeTimeFormat('en', { numeric: 'auto' });

export const grouped = (n) => GROUPED.format(n).replaceAll(',', '\u202f');

export function duration(seconds) {
  if (seconds < 60) return `${seconds.toFixed(seconds < 10 ? 2 : 1)} s`;
  const minutes = Math.floor(seconds / 60);
  const rest = Math.floor(seconds % 60).toString().padStart(2, '0');
  if (minutes < 60) return `${minutes}:${rest} min`;
  return `${Math.floor(minutes / 60)}:${(minutes % 60).toString().padStart(2, '0')}:${rest} h`;
}

export const clockTime = (seconds) => {
  const minutes = Math.floor(Math.max(0, seconds) / 60);
  return `${minutes}:${(Math.max(0, seconds) - 60 * minutes).toFixed(2).padStart(5, '0')}`;
};

export const rate = (fps) => `${Number(fps.toFixed(3))} frames/s`;

export const count = (n, one, many = `${one}s`) => `${grouped(n)} ${n === 1 ? one : many}`;

/** One line about a take, for the top of the page. */
export const takeSummary = (document) => [
  document.source.name, count(document.frames, 'frame'), rate(document.frame_rate), duration(document.duration_seconds),
].filter(Boolean).join(' · ');

/** How long ago a moment was, given as RFC 3339 has it. */
export function ago(created) {
  const seconds = (Date.now() - Date.parse(created)) / 1000;
  if (seconds < JUST) return 'just now';
  const [unit, size] = STEPS.findLast(([, length]) => seconds >= length) || STEPS[0];
  return AGO.format(-Math.max(1, Math.round(seconds / size)), unit);
}

const KEY = 'caesura.frames-from';

let first = stored(KEY) === 1 ? 1 : 0;
const listeners = new Set();

/** 0, or 1 where frames count from 1 and an interval names its last frame. */
export const firstFrameNumber = () => first;

export function setFirstFrameNumber(number) {
  first = number;
  store(KEY, number);
  for (const listener of listeners) listener();
}

/** Call back whenever numbers are shown the other way, until `signal` ends it. */
export function onFrameNumbering(listener, signal) {
  listeners.add(listener);
  signal?.addEventListener('abort', () => listeners.delete(listener));
}

/** A frame as a number to show, plain. */
export const frameNumber = (frame) => frame + first;

/** A frame, grouped by thousands. */
export const frameText = (frame) => grouped(frame + first);

/** An interval [start, end): "208–385" without its end, "209–385" with its last frame. */
export const intervalText = (start, end) => `${grouped(start + first)}–${grouped(end)}`;

/** The frame a person means by what they typed, or null. */
export function parseFrame(text) {
  const digits = text.replace(/[\s\u202f,]/g, '');
  return /^\d+$/.test(digits) ? Math.max(0, Number(digits) - first) : null;
}
