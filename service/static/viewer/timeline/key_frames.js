// Key-frames as places to go to: the nearest, the one before, the one after.

import { announce } from '../dom.js';
import { frameText } from '../number_format.js';

/** The place of the first key-frame at or after `frame`; their number where there is none. */
export function placeFrom(keys, frame) {
  let [low, high] = [0, keys.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (keys[middle].frame < frame) low = middle + 1; else high = middle;
  }
  return low;
}

/** The key-frame nearest to `frame`, no farther than `most` frames; else null. */
export function nearestKeyFrame(keys, frame, most = Infinity) {
  const at = placeFrom(keys, frame);
  const [best] = [keys[at - 1], keys[at]].filter(Boolean).sort((a, b) => Math.abs(a.frame - frame) - Math.abs(b.frame - frame));
  return best && Math.abs(best.frame - frame) <= most ? best : null;
}

/** Go to the key-frame before (-1) or after (1) the playhead. */
export function goToKeyFrame({ document: { key_frames: keys }, playhead, range, editor }, by) {
  const key = by < 0 ? keys[placeFrom(keys, playhead.frame) - 1] : keys[placeFrom(keys, playhead.frame + 1)];
  if (!key) return announce(by < 0 ? 'There is no key-frame before.' : 'There is no key-frame after.');
  editor.select(-1);
  playhead.toggle(false);
  playhead.seek(key.frame);
  range.reveal(key.frame);
  announce(`Key-frame at ${frameText(key.frame)}.`);
}

/**
 * The frame that a cut snaps to near `frame`: the key-frame or the low point of the curve that is nearest, no farther than `most`
 * frames; else `frame` itself.
 */
export function snappedFrame({ key_frames: keys, energy }, frame, most) {
  const places = lowPoints(energy, Math.floor(frame - most), Math.ceil(frame + most));
  const key = nearestKeyFrame(keys, frame, most);
  if (key) places.push(key.frame);
  return places.reduce((best, place) => (best === null || Math.abs(place - frame) < Math.abs(best - frame) ? place : best), null) ?? frame;
}

/** The frames of `[from, to]` at which the curve is lower than around it. */
function lowPoints(energy, from, to) {
  const found = [];
  for (let frame = Math.max(1, from); frame <= Math.min(energy.length - 2, to); frame++) {
    const [before, at, after] = energy.slice(frame - 1, frame + 2);
    if (at !== null && before !== null && after !== null && at < before && at <= after) found.push(frame);
  }
  return found;
}
