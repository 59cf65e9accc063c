// The best loop of a segment: where it is, how well it closes, and playing it.

import { $, screenReaderText } from '../dom.js';
import { count, duration, frameText } from '../number_format.js';

/** The best loop of a segment, if it still lies within it. */
export function loopOf({ best_loop: loop, start, end }) {
  return loop && loop.start >= start && loop.end <= end ? loop : null;
}

/** A loop in words. */
export const loopText = ({ start, end, cycles, seam, match }) =>
  `${count(cycles, 'cycle')}, frames ${frameText(start)} to ${frameText(end)}. The match is ${match}: the last pose misses the first by ${seam.toFixed(1)} steps between frames.`;

/** Offer to play the loop of the current segment over and over; hidden where there is none, or several are chosen. */
export function offerLoop({ document: { frame_rate: rate }, playhead, editor }) {
  const button = $('play-loop');
  const [segment, ...others] = editor.affected.map((index) => editor.segments[index]);
  const loop = others.length ? null : loopOf(segment);
  button.hidden = !loop;
  if (!loop) return;
  button.replaceChildren(`↻ ${duration((loop.end - loop.start) / rate)}`, screenReaderText(`, its best loop, ${loop.match} match`));
  button.className = `match ${loop.match}`;
  button.title = `Play its best loop: ${loopText(loop)}`;
  button.setAttribute('aria-pressed', String(playhead.loop?.[0] === loop.start && playhead.loop[1] === loop.end));
}

/** Play the best loop of the segment that is current, or stop to play it. */
export function playLoop(result) {
  const { document, playhead } = result;
  const loop = loopOf(document.segments[result.segmentIndexAt(playhead.frame)]);
  if (!loop) return;
  const playing = playhead.loop?.[0] === loop.start && playhead.loop[1] === loop.end;
  playhead.loop = playing ? null : [loop.start, loop.end];
  playhead.toggle(false);
  playhead.seek(loop.start);
  if (!playing) playhead.toggle(true);
}
