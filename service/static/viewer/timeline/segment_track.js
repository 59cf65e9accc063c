// The track of segments: one coloured box for each, named. It is drawn on a canvas, so that thousands cost little.

import { oncePerFrame, onResize, onThemeChange, sharpContext, styleValue } from '../dom.js';
import { motionColour, motionFill, inkOver } from '../palette.js';

const GAP = 1;
const APART = 8; // pixels between the notches of repetitions
const NOTCH = 5; // pixels high
const LEAST = 24; // pixels that a shortened name needs

export class SegmentTrack {
  #canvas; #range; #plot; #document; #current = -1;

  /** `plot()` says where the curve's plot lies, so that frames stand under each other. */
  constructor(canvas, document, range, plot, signal) {
    this.#canvas = canvas;
    this.#document = document;
    this.#range = range;
    this.#plot = plot;
    this.refresh = oncePerFrame(() => this.#draw());
    range.listen(this.refresh);
    onThemeChange(this.refresh, signal);
    onResize(canvas, this.refresh, signal);
    this.refresh();
  }

  show(document) {
    this.#document = document;
    this.#current = -1;
    this.refresh();
  }

  /** Mark the segment that plays. */
  mark(index) {
    if (index === this.#current) return;
    this.#current = index;
    this.refresh();
  }

  #draw() {
    const { context, width, height } = sharpContext(this.#canvas);
    if (!width) return;
    const plot = this.#plot();
    context.beginPath();
    context.rect(plot.left, 0, plot.width, height);
    context.clip();
    const place = (frame) => plot.left + ((frame - this.#range.from) / this.#range.length) * plot.width;
    context.font = `600 12px ${styleValue('--sans')}`;
    context.textBaseline = 'middle';
    this.#document.segments.forEach((segment, index) => {
      if (segment.end <= this.#range.from || segment.start >= this.#range.to) return;
      this.#box(context, segment, index, place(segment.start), place(segment.end), height);
    });
  }

  #box(context, segment, index, left, right, height) {
    const wide = right - left;
    const gap = wide > 4 ? GAP : 0;
    const here = index === this.#current;
    const top = here ? 0 : 4;
    context.fillStyle = motionFill(segment.motion, context);
    context.globalAlpha = segment.discard ? 0.3 : this.#current < 0 || here ? 1 : 0.82;
    context.fillRect(left + gap / 2, top, Math.max(0.5, wide - gap), height - 2 * top);
    context.globalAlpha = 1;
    this.#notches(context, segment, left, right, height - top);
    this.#label(context, segment, left, right, height);
  }

  /** A notch where each repetition begins after the first, if there is room for them. */
  #notches(context, { repeats, start, end, motion }, left, right, bottom) {
    const perFrame = (right - left) / (end - start);
    if (repeats.length < 2 || (right - left) / repeats.length < APART) return;
    context.fillStyle = inkOver(motionColour(motion));
    context.globalAlpha = 0.5;
    for (const repeat of repeats.slice(1)) context.fillRect(Math.round(left + (repeat.start - start) * perFrame), bottom - NOTCH, 1, NOTCH);
    context.globalAlpha = 1;
  }

  #label(context, segment, left, right, height) {
    const from = Math.max(left, this.#plot().left);
    const room = Math.min(right, this.#plot().left + this.#plot().width) - from;
    const mark = segment.loop ? ' ↻' : '';
    const text = fitText(context, segment.name, mark, room - 8);
    if (!text) return;
    const size = context.measureText(text).width;
    const colour = motionColour(segment.motion);
    const x = from + Math.min(8, (room - size) / 2);
    if (segment.motion >= 12) { // a plate, so that a texture never runs through the name
      context.fillStyle = colour;
      context.fillRect(x - 3, height / 2 - 8, size + 6, 16);
    }
    context.fillStyle = segment.discard ? styleValue('--ink') : inkOver(colour);
    context.fillText(text, x, height / 2 + 0.5);
  }
}

/** As much of a name, and the mark after it, as `room` pixels hold; nothing where not even two letters would stand. */
export function fitText(context, name, mark, room) {
  const wide = (text) => context.measureText(text).width;
  if (room < LEAST) return wide(name + mark) <= room ? name + mark : '';
  const letters = [...name];
  let kept = letters.length;
  let text = name + mark;
  while (wide(text) > room && kept > 2) {
    kept = Math.max(2, Math.min(kept - 1, Math.floor((kept * room) / wide(text))));
    text = `${letters.slice(0, kept).join('')}…${mark}`;
  }
  return wide(text) <= room ? text : '';
}
