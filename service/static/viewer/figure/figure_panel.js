// The figure panel: the figure is fetched, posed at the playhead and coloured; where a part is still on its way, the panel waits.

import * as api from '../service/api.js';
import { downloadFigure } from './download.js';
import { $, nextPaint } from '../dom.js';
import { motionColour } from '../palette.js';

const LATE = 250; // ms after which a wait for blocks is said
const SOON = 1500; // ms until it is asked again whether the figure is prepared

let scene = null; // one for the page: a browser gives out few WebGL contexts

export class FigurePanel {
  #signal; #moments = () => []; #request = 0; #noteTimer = 0; #retryTimer = 0; #shown = false; #colouring = 'strain';

  /** `moments()` lists what to show: one `{ position, motion }`, or two side by side. */
  constructor(moments, signal) {
    this.#moments = moments;
    this.#signal = signal;
    signal.addEventListener('abort', () => this.#leave());
  }

  get scene() { return this.#shown ? scene : null; }

  /** Whether a frame can be shown without waiting. */
  ready(frame) { return !this.#shown || scene.figure.ready(frame); }

  /** Bring the figure of a segmentation, whose viewer document may be `asked` for already, into the panel; without it the rest of the page works all the same. */
  async open(id, asked = api.viewer(id)) {
    try {
      this.showNote('Loading the figure …');
      await nextPaint(); // all else is to be seen before the drawing of the figure keeps the page busy
      const graphics = startGraphics(); // takes long, and beside all else
      const download = asked.then((viewer) => downloadFigure(viewer, this.#signal, (share) => this.#showProgress(share)));
      const [viewer, files, { FigureScene }] = await Promise.all([asked, download, import('./scene.js'), graphics]);
      if (this.#signal.aborted) return;
      scene ||= new FigureScene($('figure'));
      await scene.show(viewer, files, this.#signal);
      if (this.#signal.aborted) return;
      this.#shown = true;
      this.showNote('');
      $('upright').hidden = viewer.kind !== 'vertices';
      this.#offerStrain(scene.strain);
      scene.canvas.dataset.shown = viewer.kind;
      this.show();
    } catch (problem) {
      if (this.#signal.aborted) return;
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

  /** Show the moment, or wait for its blocks and show it then, unless another is wanted by that time. */
  show() {
    if (!this.#shown) return;
    const request = ++this.#request;
    const moments = this.#moments().map(({ position, motion }) => ({ position, colouring: this.#colourOf(motion) }));
    const missing = scene.pose(moments);
    if (!missing) return this.#clearNote();
    this.#noteTimer ||= setTimeout(() => this.showNote('Loading …'), LATE);
    missing.then(
      () => request === this.#request && this.show(),
      () => request === this.#request && this.showNote('The page cannot load this part of the take.'),
    );
  }

  /** What `StrainShading.colourBy` is told for a motion. */
  #colourOf(motion) {
    if (this.#colouring === 'plain') return null;
    return this.#colouring === 'motion' ? motionColour(motion) : 'strain';
  }

  showNote(sentence) {
    $('stage-note').textContent = sentence;
    $('stage-note').hidden = !sentence;
  }

  /** Say how much is here, as often as that is another number. */
  #showProgress(share) {
    const sentence = `Loading the figure … ${Math.round(100 * share)} %`;
    if ($('stage-note').textContent !== sentence) this.showNote(sentence);
  }

  /** Say and ask nothing more: the scene is another's. */
  #leave() {
    this.#shown = false;
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

  /** Without strain to show (joints alone, or rigid parts) the motions colour the figure. */
  #offerStrain({ present, gradient }) {
    const choice = (look) => document.querySelector(`#looks [value=${look}]`);
    choice('strain').parentElement.hidden = $('heat').hidden = !present;
    $('heat').querySelector('i').style.background = gradient;
    if (!present && choice('strain').checked) {
      choice('motion').checked = true;
      this.#colouring = 'motion';
    }
  }
}

let started = null;

/** Have a worker start the browser's graphics, once. */
function startGraphics() {
  started ??= new Promise((done) => {
    const worker = new Worker(new URL('./webgl_start.js', import.meta.url));
    worker.onmessage = worker.onerror = () => { worker.terminate(); done(); };
  });
  return started;
}
