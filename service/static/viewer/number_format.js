// Numbers as people read them.

const GROUPED = new Intl.NumberFormat('en-US');
const JUST = 45; // seconds that are still "just now"
const STEPS = [['minute', 60], ['hour', 3600], ['day', 86400]];
const AGO = new Intl.RelativeTimeFormat('en', { numeric: 'auto' });

export const whole = (n) => GROUPED.format(n).replaceAll(',', '\u202f');

export function duration(seconds) {
  if (seconds < 60) return `${seconds.toFixed(seconds < 10 ? 2 : 1)} s`;
  const minutes = Math.floor(seconds / 60);
  const rest = Math.floor(seconds % 60).toString().padStart(2, '0');
  if (minutes < 60) return `${minutes}:${rest} min`;
  return `${Math.floor(minutes / 60)}:${(minutes % 60).toString().padStart(2, '0')}:${rest} h`;
}

export const clock = (seconds) => {
  const minutes = Math.floor(Math.max(0, seconds) / 60);
  return `${minutes}:${(Math.max(0, seconds) - 60 * minutes).toFixed(2).padStart(5, '0')}`;
};

export const rate = (fps) => `${Number(fps.toFixed(3))} frames/s`;

export const count = (n, one, many = `${one}s`) => `${whole(n)} ${n === 1 ? one : many}`;

/** One line about a take, for the top of the page. */
export const about = (document) => [
  document.source.name, count(document.frames, 'frame'), rate(document.frame_rate), duration(document.duration_seconds),
].filter(Boolean).join(' · ');

/** How long ago a moment was, given in seconds since 1970. */
export function ago(created) {
  const seconds = Date.now() / 1000 - created;
  if (seconds < JUST) return 'just now';
  const [unit, size] = STEPS.findLast(([, length]) => seconds >= length) || STEPS[0];
  return AGO.format(-Math.max(1, Math.round(seconds / size)), unit);
}
