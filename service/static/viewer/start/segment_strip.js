// A take as a strip: its segments as boxes in their motions' colours, small enough for a card or a row.

import { sharpContext } from '../dom.js';
import { count } from '../number_format.js';
import { motionFill, texturedFill } from '../palette.js';

/** A canvas that shows the segments of a take of so many frames, once it has a size: in their own `colour`, or in their motion's. */
export function segmentStrip(segments, frames) {
  const canvas = document.createElement('canvas');
  canvas.className = 'strip';
  canvas.setAttribute('role', 'img');
  canvas.setAttribute('aria-label', stripText(segments));
  new ResizeObserver(() => draw(canvas, segments, frames)).observe(canvas);
  return canvas;
}

function stripText(segments) {
  const names = [...new Set(segments.map(({ name }) => name))];
  return `${count(names.length, 'motion')} in ${count(segments.length, 'segment')}: ${names.slice(0, 12).join(', ')}${names.length > 12 ? ', …' : ''}`;
}

function draw(canvas, segments, frames) {
  const { context, width, height } = sharpContext(canvas);
  for (const { start, end, motion, discard, colour, texture } of segments) {
    const left = (start / frames) * width;
    const wide = ((end - start) / frames) * width;
    context.fillStyle = colour ? texturedFill(colour, texture, context) : motionFill(motion, context);
    context.globalAlpha = discard ? 0.3 : 1;
    context.fillRect(left, 0, Math.max(0.5, wide - (wide > 4 ? 1 : 0)), height);
  }
}
