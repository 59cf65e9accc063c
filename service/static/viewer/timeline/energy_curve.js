// The energy curve, its key-frames and the cuts, over the colours of the motions.

import uPlot from 'uplot';
import { isDoubtful } from '../editing/segment_edits.js';
import { frameNumber } from '../number_format.js';
import { oncePerFrame, onResize, onThemeChange, styleValue } from '../dom.js';
import { motionColour } from '../palette.js';
import { decimate } from './decimation.js';

const AXIS = 46;
const RIGHT = 18; // room for half of the last number

export class EnergyCurve {
  #plot; #box; #range; #document; #width;

  constructor(box, document, range, signal) {
    this.#box = box;
    this.#width = box.clientWidth; // stored, because reading it makes the browser lay out the page
    this.#range = range;
    this.#document = document;
    this.refresh = oncePerFrame(() => this.#fill());
    range.listen(this.refresh);
    onThemeChange(() => this.#draw(), signal);
    this.#draw();
    onResize(box, () => this.#fit(), signal);
  }

  /** Show another cut of the same take. */
  show(document) {
    this.#document = document;
    this.#draw();
  }

  /** The same curve with other segments under it. */
  edited(document) {
    this.#document = document;
    this.refresh();
  }

  /** Where the plot lies in its box, in CSS pixels: the timeline and the playhead line up with it. */
  get plot() { return { left: AXIS, width: Math.max(10, this.#width - AXIS - RIGHT) }; }

  #draw() {
    this.#plot?.destroy();
    this.#box.replaceChildren();
    const [low, high] = fittedRange(this.#document.energy);
    const faint = styleValue('--faint');
    const grid = { stroke: styleValue('--hairline'), width: 1 };
    const axis = { stroke: faint, grid, ticks: { show: false }, font: `11px ${styleValue('--sans')}` };
    this.#plot = new uPlot({
      width: this.#width || 600,
      height: this.#box.clientHeight || 150,
      padding: [6, RIGHT, 0, 0],
      legend: { show: false },
      cursor: { show: false },
      scales: {
        x: { time: false, range: () => [this.#range.from, this.#range.to] },
        y: { range: () => [low, high] },
      },
      axes: [
        { ...axis, size: 22, gap: 4, space: 70, values: (_, ticks) => ticks.map((t) => (Number.isInteger(t) ? frameNumber(t) : '')) },
        { ...axis, size: AXIS, gap: 6, space: 22, values: (_, ticks) => ticks.map((t) => +t.toFixed(2)) },
      ],
      series: [{}, { stroke: styleValue('--ink'), width: 1.5, points: { show: false }, spanGaps: false }],
      hooks: { drawClear: [(u) => this.#underlay(u)], draw: [(u) => this.#overlay(u)] },
    }, [[0], [null]], this.#box);
    this.#fill();
  }

  #fit() {
    this.#width = this.#box.clientWidth;
    if (!this.#width) return;
    this.#plot.setSize({ width: this.#width, height: this.#box.clientHeight });
    this.refresh();
  }

  #fill() {
    const { from, to } = this.#range;
    this.#plot.setData(decimate(this.#document.energy, from, to, this.plot.width));
  }

  /** Draw the motion of each segment, as a tint behind the curve. */
  #underlay(u) {
    const { ctx, bbox } = u;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.globalAlpha = Number(styleValue('--tint'));
    const faint = styleValue('--faint');
    for (const segment of this.#visible()) {
      const left = u.valToPos(segment.start, 'x', true);
      ctx.fillStyle = segment.discard ? faint : motionColour(segment.motion);
      ctx.fillRect(left, bbox.top, u.valToPos(segment.end, 'x', true) - left, bbox.height);
    }
    ctx.restore();
  }

  /** Draw cuts as lines, dashed where the method doubts them; key-frames as dots in their motion's colour. */
  #overlay(u) {
    const { ctx, bbox } = u;
    const ratio = devicePixelRatio || 1;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = styleValue('--ink');
    ctx.lineWidth = ratio;
    const visible = this.#visible();
    // A line every few pixels would hide the curve: the closer they stand, the fainter they are.
    ctx.globalAlpha = Math.min(0.6, this.plot.width / visible.length / 40);
    for (const segment of visible) {
      if (segment.end >= this.#document.frames) continue;
      ctx.setLineDash(isDoubtful(segment) ? [3 * ratio, 3 * ratio] : []);
      const x = Math.round(u.valToPos(segment.end, 'x', true)) + 0.5;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
    ctx.setLineDash([]);
    ctx.globalAlpha = 1;
    this.#keys(u, ctx, ratio);
    ctx.restore();
  }

  #keys(u, ctx, ratio) {
    const { from, to } = this.#range;
    const keys = this.#document.key_frames.filter((key) => key.frame >= from && key.frame < to);
    // Thousands of dots are a smear: shrink them as they crowd.
    const radius = Math.max(1.2, Math.min(4, (2.2 * this.plot.width) / Math.max(1, keys.length) / 4)) * ratio;
    ctx.strokeStyle = styleValue('--panel');
    ctx.lineWidth = radius > 2 * ratio ? 1.5 * ratio : 0;
    for (const key of keys) {
      ctx.fillStyle = motionColour(key.motion);
      ctx.beginPath();
      ctx.arc(u.valToPos(key.frame, 'x', true), u.valToPos(key.energy, 'y', true), radius, 0, 7);
      ctx.fill();
      if (ctx.lineWidth) ctx.stroke();
    }
  }

  #visible() {
    const { from, to } = this.#range;
    return this.#document.segments.filter((segment) => segment.end > from && segment.start < to);
  }
}

/** The lowest and the highest value, with a little room; of a flat curve some room all the same. */
function fittedRange(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (value === null) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  const room = Math.max((high - low) * 0.12, Math.abs(high) * 0.02, 1e-3);
  return [Math.max(0, low - room), high + room];
}
