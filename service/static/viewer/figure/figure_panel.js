// The figure panel: it fetches the figure, poses it at the playhead and colours it, and says what it waits for.

import * as api from '../service/api.js';
import { downloadFigure } from './download.js';
import { isSoftware, probeRenderer } from './renderer_probe.js';
import { $, nextPaint } from '../dom.js';
import { motionColour } from '../palette.js';

const LATE = 250; // ms after which the panel says that it waits for blocks
const SOON = 1500; // ms until the panel asks again whether the figure is prepared

let scene = null; // one for the page: a browser gives out few WebGL contexts

export class FigurePanel {
  #signal; #poses; #whenShown; #request = 0; #noteTimer = 0; #retryTimer = 0; #shown = false; #dressed = false; #colouring = 'own';

  /**
   * `poses` are the `ShownPoses`: its `poses` side by side, and its `ghosts` over them, seen through.
   * `whenShown()` is called once the figure is there as its author made it.
   */
  constructor(poses, signal, whenShown = () => {}) {
    this.#whenShown = whenShown;
    this.#poses = poses;
    this.#signal = signal;
    signal.addEventListener('abort', () => this.#leave());
  }

  get scene() { return this.#shown ? scene : null; }

  /** The scene, once the figure wears what its author gave it. */
  get dressedScene() { return this.#dressed ? scene : null; }

  /** Whether a frame can be shown without waiting. */
  ready(frame) { return !this.#shown || scene.figure.ready(frame); }

  /** Show the figure of a segmentation; `asked` is the promise of its viewer document. Without a figure the rest of the page works. */
  async open(id, asked = api.viewer(id)) {
    const failed = new AbortController(); // what is still on its way is not wanted, and says no more how far it is
    const signal = AbortSignal.any([this.#signal, failed.signal]);
    const progress = (share) => signal.aborted || this.#showProgress(share);
    try {
      this.showNote('Loading the figure …');
      const download = asked.then((viewer) => downloadFigure(viewer, signal, progress));
      download.catch(() => {}); // handled below
      await nextPaint(); // the person sees all else before the figure keeps the page busy
      const probe = probeRenderer(); // takes long, so it runs beside all else
      const [viewer, files, { FigureScene }, renderer] = await Promise.all([asked, download, import('./scene.js'), probe]);
      if (this.#signal.aborted) return;
      scene ||= new FigureScene($('figure'), isSoftware(renderer));
      await scene.show(viewer, files, this.#signal);
      if (this.#signal.aborted) return;
      this.#shown = true;
      this.showNote('');
      $('upright').hidden = viewer.kind !== 'vertices';
      this.#offerStrain(scene.strain);
      scene.canvas.dataset.shown = viewer.kind;
      this.show();
      if (files.materials) await scene.dress(files.materials()).catch(() => {}); // their plain colours are there
      this.#dressed = this.#shown;
      this.#whenShown();
    } catch (problem) {
      if (this.#signal.aborted) return;
      failed.abort();
      const soon = problem.document?.code === 'not-finished';
      this.showNote(soon ? 'The service still prepares the figure.' : `The page cannot show the figure: ${problem.message}`);
      if (soon) this.#retryTimer = setTimeout(() => this.open(id), SOON);
    }
  }

  colourBy(choice) {
    this.#colouring = choice;
    $('heat').classList.toggle('off', choice !== 'strain');
    this.show();
  }

  /** Show the current poses; if their blocks are missing, wait for them, unless other poses are requested meanwhile. */
  show() {
    if (!this.#shown) return;
    const request = ++this.#request;
    const poses = this.#poses.poses.map(({ position, motion, start }) => ({ position, start, colouring: this.#colourOf(motion) }));
    const ghosts = this.#poses.ghosts.map(({ position, motion, start }) => ({ position, start, colouring: motionColour(motion) }));
    const missing = scene.pose(poses, ghosts);
    if (!missing) return this.#clearNote();
    this.#noteTimer ||= setTimeout(() => this.showNote('Loading …'), LATE);
    missing.then(
      () => request === this.#request && this.show(),
      () => request === this.#request && this.showNote('The page cannot load this part of the take.'),
    );
  }

  /** The colouring of a motion, for `SurfaceShading.colourBy`. */
  #colourOf(motion) {
    if (this.#colouring === 'own') return null;
    return this.#colouring === 'motion' ? motionColour(motion) : 'strain';
  }

  showNote(sentence) {
    $('stage-note').textContent = sentence;
    $('stage-note').hidden = !sentence;
  }

  /** Say how much has been fetched, whenever the number changes. */
  #showProgress(share) {
    const sentence = `Loading the figure … ${Math.round(100 * share)} %`;
    if ($('stage-note').textContent !== sentence) this.showNote(sentence);
  }

  /** Leave the scene to another result. */
  #leave() {
    this.#shown = this.#dressed = false;
    this.#request++;
    clearTimeout(this.#noteTimer);
    clearTimeout(this.#retryTimer);
    scene?.clear();
  }

  #clearNote() {
    if (!this.#noteTimer) return;
    clearTimeout(this.#noteTimer);
    this.#noteTimer = 0;
    this.showNote('');
  }

  /** Offer strain and its legend; a figure without strain (joints alone, rigid parts) has its own colours. */
  #offerStrain({ present, gradient }) {
    const choice = (look) => document.querySelector(`#looks [value=${look}]`);
    choice('strain').parentElement.hidden = $('heat').hidden = !present;
    $('heat').querySelector('i').style.background = gradient;
    if (!present && choice('strain').checked) {
      choice('own').checked = true;
      this.colourBy('own');
    }
  }
}
