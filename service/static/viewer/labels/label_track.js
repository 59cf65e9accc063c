// The track of labels under the segments: a box for each, in the colour of the motion that it most nearly is.

import { $, oncePerFrame, onResize, onThemeChange, sharpContext, styleValue } from '../dom.js';
import { count } from '../number_format.js';
import { inkOver, motionColour } from '../palette.js';
import { agreement } from './agreement.js';
import { LabelProblem, readLabels } from './label_file.js';

const LARGEST = 20 * 2 ** 20; // bytes of a file

export class LabelTrack {
  #canvas = $('labels'); #document; #range; #plot; #labels = null; #name = ''; #motions = new Map();

  /** `plot()` says where the curve's plot lies. */
  constructor(document, range, plot, signal) {
    this.#document = document;
    this.#range = range;
    this.#plot = plot;
    this.refresh = oncePerFrame(() => this.#draw());
    range.listen(this.refresh);
    onThemeChange(this.refresh, signal);
    onResize(this.#canvas, this.refresh, signal);
    signal.addEventListener('abort', () => this.close());
  }

  /** Compare with the labels of a file; a file that has none is refused in a sentence. */
  async open(file) {
    try {
      if (file.size > LARGEST) throw new LabelProblem('The file is larger than 20 MB.');
      this.#labels = readLabels(await file.text(), this.#document);
      this.#name = file.name;
      this.#show();
    } catch (problem) {
      if (!(problem instanceof LabelProblem)) throw problem;
      $('labels-note').textContent = `${file.name}: ${problem.message}`;
    }
  }

  close() {
    this.#labels = null;
    this.#show();
  }

  /** The segments are others now. */
  show(document) {
    this.#document = document;
    if (this.#labels) this.#show();
  }

  #show() {
    $('labels').hidden = $('labels-close').hidden = !this.#labels;
    $('labels-note').textContent = '';
    if (!this.#labels) return;
    const { motions, share, cuts, expected } = agreement(this.#labels, this.#document);
    this.#motions = motions;
    $('labels-note').textContent = `${this.#name}: ${Math.round(100 * share)} % of its frames agree. ${expected ? `${cuts} of its ${count(expected, 'cut')} have one within half a second.` : ''}`;
    $('labels').setAttribute('aria-label', `Labels of ${this.#name}: ${this.#labels.map(({ name }) => name).slice(0, 200).join(', ')}`);
    this.refresh();
  }

  #draw() {
    const { context, width, height } = sharpContext(this.#canvas);
    if (!width || !this.#labels) return;
    const { left, width: wide } = this.#plot();
    const { from, to, length } = this.#range;
    context.save();
    context.beginPath();
    context.rect(left, 0, wide, height);
    context.clip();
    context.font = `600 11px ${styleValue('--sans')}`;
    context.textBaseline = 'middle';
    for (const { start, end, name } of this.#labels) {
      if (end <= from || start >= to) continue;
      const x = left + ((start - from) / length) * wide;
      const across = ((end - start) / length) * wide;
      const motion = this.#motions.get(name);
      const colour = motion === undefined ? styleValue('--grid') : motionColour(motion);
      context.fillStyle = colour;
      context.fillRect(x, 0, Math.max(0.5, across - 1), height);
      const shown = Math.max(x, left) + 6;
      if (context.measureText(name).width > x + across - shown - 4) continue;
      context.fillStyle = colour.startsWith('#') ? inkOver(colour) : styleValue('--ink');
      context.fillText(name, shown, height / 2 + 0.5);
    }
    context.restore();
  }
}
