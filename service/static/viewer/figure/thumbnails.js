// Small pictures of poses: those that are kept with the result, and others, drawn while nobody waits for anything.

import { keepDrawn, keptPictures } from './kept_pictures.js';

const WIDTH = 96;
const HEIGHT = 72;
const MOST = 600; // that are kept
const REST = 250; // ms since the last one was asked for: while a person drags or zooms, none is drawn
const BUSY = 300; // ms until it is tried again while the take plays
const BUDGET = 10; // ms of drawing at a time; after it the stage is drawn once
const SETTLED = 2000; // ms after the last one was drawn until they are kept with the result

const whenIdle = globalThis.requestIdleCallback
  ? (action) => requestIdleCallback(action, { timeout: 1000 }) : (action) => setTimeout(action);

export class Thumbnails {
  #scene; #busy; #pictures = new Map(); #waiting = new Map(); #timer = 0; #signal; #keep = null; #keepTimer = 0; #asked = true;

  /** `scene()` is what draws, or null before there is a figure; `busy()` is whether a person waits for it to draw. */
  constructor(scene, busy, signal) {
    this.#scene = scene;
    this.#busy = busy;
    this.#signal = signal;
    signal.addEventListener('abort', () => { clearTimeout(this.#timer); clearTimeout(this.#keepTimer); });
  }

  /**
   * Take over the pictures that are kept with result `id`. Where there are none, those that are drawn become them, with the
   * picture of frame `poster` to stand for the result; not of one that is only to be looked at (`fixed`).
   */
  async open(id, poster, fixed) {
    clearTimeout(this.#keepTimer);
    this.#keep = null;
    this.#asked = true;
    const kept = await keptPictures(id).catch(() => null);
    if (this.#signal.aborted) return;
    this.#asked = false;
    if (kept) this.#put(kept);
    else if (!fixed) this.#keep = { id, poster };
    this.#later(0);
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
    if (this.#asked) return; // what is kept need not be drawn
    if (this.#waiting.size && !this.#signal.aborted) this.#timer = setTimeout(() => whenIdle(() => this.#drawSome()), rest);
  }

  #drawSome() {
    const scene = this.#scene();
    if (!scene || this.#signal.aborted) return;
    if (this.#busy()) return this.#later(BUSY);
    const ready = [...this.#waiting.keys()].filter((frame) => scene.figure.ready(frame));
    const missing = [...this.#waiting.keys()].find((frame) => !scene.figure.ready(frame));
    this.#put(scene.pictures(ready, WIDTH, HEIGHT, BUDGET));
    this.#keepSoon();
    if (ready.length) this.#later(0);
    else if (missing !== undefined) scene.figure.fetch(missing).then(() => this.#later(0), () => this.#waiting.delete(missing));
  }

  /** Take over pictures, pairs of a frame and what can be drawn, and tell those who wait for them. */
  #put(pictures) {
    const listeners = new Set();
    for (const [frame, picture] of pictures) {
      this.#pictures.set(frame, picture);
      for (const whenDrawn of this.#waiting.get(frame) ?? []) listeners.add(whenDrawn);
      this.#waiting.delete(frame);
    }
    while (this.#pictures.size > MOST) this.#pictures.delete(this.#pictures.keys().next().value);
    for (const whenDrawn of listeners) whenDrawn();
  }

  /** Keep what is drawn with the result, once nothing more is to be drawn. */
  #keepSoon() {
    clearTimeout(this.#keepTimer);
    if (!this.#keep || this.#waiting.size || this.#signal.aborted) return;
    this.#keepTimer = setTimeout(() => {
      const { id, poster } = this.#keep;
      this.#keep = null;
      keepDrawn(id, this.#pictures, poster).catch(() => {}); // they are drawn again the next time
    }, SETTLED);
  }
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
