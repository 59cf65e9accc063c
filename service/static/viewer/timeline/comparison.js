// Comparing the repeats of a motion: its segments, or the repetitions of its only one, in one rhythm, side by side or overlaid.

import { $ } from '../dom.js';
import { duration } from '../number_format.js';
import { segmentSeconds } from '../editing/segment_edits.js';
import { repeatSegment } from './navigation.js';

const MOST = 6;
const WIDTH = 150; // pixels that one picture needs
const MOST_OVERLAID = 8;

/** The segments of the motion of segment `index`, or the repetitions of it where it is the only one; each with its label. */
export function repeatsOf(document, index) {
  const { segments } = document;
  const { motion, repeats } = segments[index];
  const same = segments.filter((segment) => segment.motion === motion && !segment.discard);
  const several = same.length > 1;
  const parts = several ? same : repeats.map((repeat) => ({ ...segments[index], ...repeat, repeats: [] }));
  return parts.map((part, i) => ({ part, text: `${i + 1} of ${parts.length} · ${duration(segmentSeconds(document, part))}` }));
}

/**
 * Where in `to` its motion is as far as at `frame` in `from`: in the same cycle at the same share of it, or, where one of them
 * has no repetitions, at the same share of the whole.
 */
export function inRhythm(frame, from, to) {
  const cycles = from.repeats.length > 1 && to.repeats.length > 1;
  const at = cycles ? from.repeats.findLastIndex(({ start }) => start <= frame) : 0;
  const cycle = cycles ? from.repeats[Math.max(0, at)] : from;
  const other = cycles ? to.repeats[Math.max(0, at) % to.repeats.length] : to;
  const share = (frame - cycle.start) / (cycle.end - cycle.start);
  return Math.min(other.end - 1e-3, other.start + Math.max(0, share) * (other.end - other.start));
}

/** At most `most` of the items, evenly chosen; the one at `current` is among them. */
function evenly(items, most, current) {
  if (items.length <= most) return items;
  const chosen = new Set(Array.from({ length: most }, (_, i) => Math.round((i * (items.length - 1)) / (most - 1))));
  if (!chosen.has(current)) {
    chosen.delete([...chosen].reduce((near, i) => (Math.abs(i - current) < Math.abs(near - current) ? i : near)));
    chosen.add(current);
  }
  return [...chosen].sort((a, b) => a - b).map((i) => items[i]);
}

/** What is compared at a frame: `{ position, segment, text, current }` of each; null where there is nothing to compare. */
export function comparedPoses(document, index, position, way, width) {
  const items = repeatsOf(document, index);
  const at = items.findIndex(({ part }) => part.start <= position && position < part.end);
  if (items.length < 2 || at < 0) return null;
  const most = way === 'over' ? MOST_OVERLAID : Math.max(2, Math.min(MOST, Math.floor(width / WIDTH)));
  return evenly(items, most, at).map(({ part, text }) => ({
    position: part === items[at].part ? position : inRhythm(position, items[at].part, part),
    segment: part,
    text,
    current: part === items[at].part,
  }));
}

/** Wire the menu once. While repeats are compared, the segment is played again and again. */
export function addComparison(shown) {
  let repeated = false;
  $('compare').addEventListener('change', ({ target: { value } }) => {
    const repeat = $('loop');
    if (value && !repeat.checked) repeated = repeat.checked = true;
    else if (!value && repeated) repeated = repeat.checked = false;
    const result = shown();
    result.editor.select(-1);
    repeatSegment(result, repeat.checked);
    result.playhead.notify();
  });
}

/** The next way to compare: none, side by side, overlaid. */
export function compareNext() {
  const menu = $('compare');
  menu.selectedIndex = (menu.selectedIndex + 1) % menu.options.length;
  menu.dispatchEvent(new Event('change'));
}
