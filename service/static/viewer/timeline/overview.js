// The overview: the whole take as a strip, with a window around what the timeline shows. The window can be dragged.

import { oncePerFrame, onResize, onThemeChange, sharpContext, styleValue } from '../dom.js';
import { motionFill } from '../palette.js';

const NARROWEST = 6; // pixels of the window

export class Overview {
  #canvas; #document; #range; #plot; #grip = null;

  /** `plot()` says where the curve's plot lies. */
  constructor(canvas, document, range, plot, signal) {
    this.#canvas = canvas;
    this.#document = document;
    this.#range = range;
    this.#plot = plot;
    this.refresh = oncePerFrame(() => this.#draw());
    range.listen(this.refresh);
    onThemeChange(this.refresh, signal);
    onResize(canvas, this.refresh, signal);
    const on = (name, action) => canvas.addEventListener(name, action, { signal });
    on('pointerdown', (event) => this.#press(event));
    on('pointermove', (event) => { if (this.#grip !== null) this.#centre(this.#frameAt(event) - this.#grip); });
    for (const name of ['pointerup', 'pointercancel']) on(name, () => { this.#grip = null; });
  }

  show(document) {
    this.#document = document;
    this.refresh();
  }

  #frameAt({ clientX }) {
    const { left, width } = this.#plot();
    return ((clientX - this.#canvas.getBoundingClientRect().left - left) / width) * this.#range.frames;
  }

  /** Take hold of the window, or bring it to where a person pressed. */
  #press(event) {
    this.#canvas.setPointerCapture(event.pointerId);
    const frame = this.#frameAt(event);
    const { from, to, length } = this.#range;
    this.#grip = frame >= from && frame < to ? frame - (from + length / 2) : 0;
    this.#centre(frame - this.#grip);
  }

  #centre(frame) { this.#range.set(frame - this.#range.length / 2, frame + this.#range.length / 2); }

  #draw() {
    const { context, height } = sharpContext(this.#canvas);
    const { left, width } = this.#plot();
    const { frames, from, to } = this.#range;
    const place = (frame) => left + (frame / frames) * width;
    for (const { start, end, motion, discard } of this.#document.segments) {
      context.fillStyle = motionFill(motion, context);
      context.globalAlpha = discard ? 0.3 : 1;
      context.fillRect(place(start), 3, Math.max(0.5, place(end) - place(start)), height - 6);
    }
    context.globalAlpha = 0.72;
    context.fillStyle = styleValue('--panel');
    const [start, end] = [place(from), Math.max(place(to), place(from) + NARROWEST)];
    context.fillRect(left, 0, start - left, height);
    context.fillRect(end, 0, left + width - end, height);
    context.globalAlpha = 1;
    context.strokeStyle = styleValue('--faint');
    context.lineWidth = 1.5;
    context.strokeRect(start + 0.75, 0.75, Math.max(1, end - start - 1.5), height - 1.5);
  }
}
