// The track of segments: a box for each, with its name in its motion's colour over pictures of its poses. It is drawn on a canvas,
// so that thousands cost little.

import { oncePerFrame, onResize, onThemeChange, sharpContext, styleValue } from '../dom.js';
import { portraitFrame } from '../editing/segment_edits.js';
import { motionColour, motionFill, inkOver } from '../palette.js';

const GAP = 1;
const BAND = 20; // pixels high, of the name
const APART = 8; // pixels between the notches of repetitions
const NOTCH = 5; // pixels high
const LEAST = 24; // pixels that a shortened name needs
const MOST_PICTURES = 4; // in a box

export class SegmentTrack {
  #canvas; #range; #plot; #document; #picture; #current = -1; #selected = new Set();

  /**
   * `plot()` says where the curve's plot lies, so that frames stand under each other; `picture(frame, whenDrawn)` answers the
   * picture of a pose, or draws it later.
   */
  constructor(canvas, document, range, plot, picture, signal) {
    this.#canvas = canvas;
    this.#document = document;
    this.#range = range;
    this.#plot = plot;
    this.#picture = picture;
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

  /** Mark the segments that are selected, by their indices. */
  select(indices) {
    this.#selected = indices;
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
    const [x, inner] = [left + gap / 2, Math.max(0.5, wide - gap)];
    const strong = index === this.#current || this.#selected.has(index);
    context.fillStyle = motionFill(segment.motion, context);
    context.globalAlpha = segment.discard ? 0.12 : strong ? 0.5 : 0.28;
    context.fillRect(x, BAND, inner, height - BAND);
    context.globalAlpha = segment.discard ? 0.35 : 1;
    context.fillRect(x, 0, inner, BAND);
    this.#pictures(context, segment, left, right, height);
    context.globalAlpha = 1;
    this.#notches(context, segment, left, right, height);
    this.#label(context, segment, left, right);
    if (!strong) return;
    context.strokeStyle = styleValue('--ink');
    context.lineWidth = 2;
    context.strokeRect(x + 1, 1, Math.max(0, inner - 2), height - 2);
  }

  /** Pictures of poses, as many as there is room for: one, two or four, evenly over the segment. */
  #pictures(context, segment, left, right, height) {
    const { start, end } = segment;
    const high = height - BAND - 2;
    const wide = (high * 4) / 3;
    const room = Math.floor((right - left) / (wide * 1.15));
    if (right - left < wide / 3 || high < 16) return;
    const count = room >= MOST_PICTURES ? MOST_PICTURES : Math.max(1, Math.min(2, room));
    const cell = (right - left) / count;
    for (let i = 0; i < count; i++) {
      const middle = left + (i + 0.5) * cell;
      if (middle + wide < this.#plot().left || middle - wide > this.#plot().left + this.#plot().width) continue;
      const frame = count > 1 ? Math.floor(start + ((i + 0.5) / count) * (end - start)) : portraitFrame(segment);
      const picture = this.#picture(frame, this.refresh);
      if (!picture) continue;
      const shown = Math.min(1, (cell - 2) / wide); // what does not fit of its sides is left out
      context.drawImage(picture, (picture.width * (1 - shown)) / 2, 0, picture.width * shown, picture.height, middle - (wide * shown) / 2, BAND + 1, wide * shown, high);
    }
  }

  /** A notch where each repetition begins after the first, if there is room for them. */
  #notches(context, { repeats, start, end }, left, right, bottom) {
    const perFrame = (right - left) / (end - start);
    if (repeats.length < 2 || (right - left) / repeats.length < APART) return;
    context.fillStyle = styleValue('--ink');
    context.globalAlpha = 0.55;
    for (const repeat of repeats.slice(1)) context.fillRect(Math.round(left + (repeat.start - start) * perFrame), bottom - NOTCH, 1, NOTCH);
    context.globalAlpha = 1;
  }

  #label(context, segment, left, right) {
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
      context.fillRect(x - 3, 2, size + 6, BAND - 4);
    }
    context.fillStyle = segment.discard ? styleValue('--ink') : inkOver(colour);
    context.fillText(text, x, BAND / 2 + 0.5);
    if (segment.discard) context.fillRect(x, BAND / 2, size, 1);
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
