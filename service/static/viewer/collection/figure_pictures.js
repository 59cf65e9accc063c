// Pictures of poses of many takes, drawn one figure after the other on a canvas that nobody sees.

import * as api from '../service/api.js';
import { nextPaint } from '../dom.js';
import { downloadFigure } from '../figure/download.js';
import { isSoftware, probeRenderer } from '../figure/renderer_probe.js';

const WIDTH = 192;
const HEIGHT = 144;
const BUDGET = 12; // ms of drawing at a time
const SOON = 1500; // ms until it is asked again whether a figure is prepared
const ATTEMPTS = 20;

let scene = null; // one for the page: a browser gives out few WebGL contexts

export class FigurePictures {
  #place; #signal; #shown = ''; #last = Promise.resolve(); #kept = new Map();

  /** `place` has the canvas that is drawn on, and a size. */
  constructor(place, signal) {
    this.#place = place;
    this.#signal = signal;
    signal.addEventListener('abort', () => scene?.clear());
  }

  /** Pictures of frames of a segmentation's take, in their order. Rejects where there is no figure or no WebGL. */
  of(segmentation, frames) {
    const key = `${segmentation} ${frames}`;
    if (!this.#kept.has(key)) {
      const drawn = this.#last.then(() => this.#draw(segmentation, frames));
      this.#last = drawn.catch(() => this.#kept.delete(key));
      this.#kept.set(key, drawn);
    }
    return this.#kept.get(key);
  }

  async #draw(segmentation, frames) {
    await this.#show(segmentation);
    await Promise.all([...new Set(frames)].map((frame) => scene.figure.fetch(frame)));
    const drawn = new Map();
    for (let left = [...new Set(frames)]; left.length; left = left.filter((frame) => !drawn.has(frame))) {
      this.#signal.throwIfAborted();
      for (const [frame, picture] of scene.pictures(left, WIDTH, HEIGHT, BUDGET)) drawn.set(frame, picture);
      await nextPaint(); // a person may want to do something meanwhile
    }
    return frames.map((frame) => drawn.get(frame));
  }

  async #show(segmentation) {
    this.#signal.throwIfAborted();
    if (this.#shown === segmentation) return;
    const viewer = await viewerOf(segmentation, this.#signal);
    const [{ FigureScene }, renderer] = await Promise.all([import('../figure/scene.js'), probeRenderer()]);
    scene ||= new FigureScene(this.#place.querySelector('canvas'), isSoftware(renderer), { turns: false });
    this.#shown = '';
    await scene.show(viewer, downloadFigure(viewer, this.#signal), this.#signal);
    this.#signal.throwIfAborted();
    this.#shown = segmentation;
  }
}

/** The viewer document of a segmentation, as soon as the figure is prepared. */
export async function viewerOf(segmentation, signal) {
  for (let attempt = 0; ; attempt++) {
    try { return await api.viewer(segmentation); } catch (problem) {
      if (problem.document?.code !== 'not-finished' || attempt === ATTEMPTS) throw problem;
      await new Promise((done) => setTimeout(done, SOON));
      signal.throwIfAborted();
    }
  }
}

/** Draw a picture into a canvas once it is there; without it the canvas stays empty. */
export async function drawPicture(pictures, segmentation, frame, canvas) {
  const [picture] = await pictures.of(segmentation, [frame]).catch(() => []);
  if (!picture) return;
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.drawImage(picture, 0, 0, canvas.width, canvas.height);
  canvas.dataset.drawn = 'yes';
}
