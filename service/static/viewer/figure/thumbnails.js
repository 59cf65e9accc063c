// Small pictures of poses, drawn while nobody waits for anything, and kept for as long as the result is open.

const WIDTH = 96;
const HEIGHT = 72;
const MOST = 600; // that are kept
const REST = 250; // ms since the last one was asked for: while a person drags or zooms, none is drawn
const BUSY = 300; // ms until it is tried again while the take plays
const BUDGET = 10; // ms of drawing at a time; after it the stage is drawn once

const whenIdle = globalThis.requestIdleCallback
  ? (action) => requestIdleCallback(action, { timeout: 1000 }) : (action) => setTimeout(action);

export class Thumbnails {
  #scene; #busy; #pictures = new Map(); #waiting = new Map(); #timer = 0; #signal;

  /** `scene()` is what draws, or null before there is a figure; `busy()` is whether a person waits for it to draw. */
  constructor(scene, busy, signal) {
    this.#scene = scene;
    this.#busy = busy;
    this.#signal = signal;
    signal.addEventListener('abort', () => clearTimeout(this.#timer));
  }

  /** The picture of a frame if it is drawn; else it is drawn later, and each `whenDrawn` of it called. */
  of(frame, whenDrawn) {
    const found = this.#pictures.get(frame);
    if (!found && whenDrawn) {
      if (!this.#waiting.has(frame)) this.#waiting.set(frame, new Set());
      this.#waiting.get(frame).add(whenDrawn);
      this.#later(REST);
    }
    return found ?? null;
  }

  /** Go on drawing, once there is a figure to draw. */
  resume() { this.#later(0); }

  #later(rest) {
    clearTimeout(this.#timer);
    if (this.#waiting.size && !this.#signal.aborted) this.#timer = setTimeout(() => whenIdle(() => this.#drawSome()), rest);
  }

  #drawSome() {
    const scene = this.#scene();
    if (!scene || this.#signal.aborted) return;
    if (this.#busy()) return this.#later(BUSY);
    const told = new Set();
    const ready = [...this.#waiting.keys()].filter((frame) => scene.figure.ready(frame));
    const missing = [...this.#waiting.keys()].find((frame) => !scene.figure.ready(frame));
    for (const [frame, picture] of scene.pictures(ready, WIDTH, HEIGHT, BUDGET)) {
      this.#pictures.set(frame, picture);
      for (const whenDrawn of this.#waiting.get(frame)) told.add(whenDrawn);
      this.#waiting.delete(frame);
    }
    while (this.#pictures.size > MOST) this.#pictures.delete(this.#pictures.keys().next().value);
    for (const whenDrawn of told) whenDrawn();
    if (ready.length) this.#later(0);
    else if (missing !== undefined) scene.figure.fetch(missing).then(() => this.#later(0), () => this.#waiting.delete(missing));
  }
}

/** The frame that stands for a segment: its key-frame nearest to its middle, or its middle. */
export function portraitFrame({ start, end }, keyFrames) {
  const middle = Math.floor((start + end) / 2);
  let best = null;
  for (const { frame } of keyFrames) {
    if (frame < start || frame >= end) continue;
    if (best === null || Math.abs(frame - middle) < Math.abs(best - middle)) best = frame;
  }
  return best ?? middle;
}

/** A canvas with the picture of a frame, there or as soon as it is drawn. */
export function portraitCanvas(thumbnails, frame) {
  const place = Object.assign(document.createElement('canvas'), { width: WIDTH, height: HEIGHT });
  const put = () => {
    const picture = thumbnails.of(frame, put);
    if (picture) place.getContext('2d').drawImage(picture, 0, 0);
  };
  put();
  return place;
}
