// The figure on stage, at the moment: it is fetched, posed, coloured, and waited for where a part is still on its way.

import * as api from '../service/api.js';
import { askFigure } from './download.js';
import { $, painted } from '../dom.js';
import { colourOf } from '../palette.js';

const LATE = 250; // ms after which a wait for blocks is said
const SOON = 1500; // ms until it is asked again whether the figure is prepared

let stage = null; // one for the page: a browser gives out few WebGL contexts

export class Presence {
  #signal; #moments = () => []; #wanted = 0; #late = 0; #again = 0; #here = false; #look = 'strain';

  /** `moments()` lists what to show: one `{ position, motion }`, or two side by side. */
  constructor(moments, signal) {
    this.#moments = moments;
    this.#signal = signal;
    signal.addEventListener('abort', () => this.#leave());
  }

  get stage() { return this.#here ? stage : null; }

  /** Whether a frame can be shown without waiting. */
  ready(frame) { return !this.#here || stage.figure.ready(frame); }

  /** Bring the figure of a segmentation, whose viewer document may be `asked` for already, onto the stage; without it the rest of the page works all the same. */
  async enter(id, asked = api.viewer(id)) {
    try {
      this.tell('Loading the figure …');
      await painted(); // all else is to be seen before the drawing of the figure keeps the page busy
      const graphics = startGraphics(); // takes long, and beside all else
      const arriving = asked.then((viewer) => askFigure(viewer, this.#signal, (share) => this.#arriving(share)));
      const [viewer, coming, { Stage }] = await Promise.all([asked, arriving, import('./scene.js'), graphics]);
      if (this.#signal.aborted) return;
      stage ||= new Stage($('figure'));
      await stage.show(viewer, coming, this.#signal);
      if (this.#signal.aborted) return;
      this.#here = true;
      this.tell('');
      $('upright').hidden = viewer.kind !== 'vertices';
      this.#offerStrain(stage.strain);
      stage.canvas.dataset.shown = viewer.kind;
      this.show();
    } catch (problem) {
      if (this.#signal.aborted) return;
      const soon = problem.document?.code === 'not-finished';
      this.tell(soon ? 'The figure is still being prepared.' : `The figure cannot be shown: ${problem.message}`);
      if (soon) this.#again = setTimeout(() => this.enter(id), SOON);
    }
  }

  look(choice) {
    this.#look = choice;
    $('heat').classList.toggle('off', choice !== 'strain');
    this.show();
  }

  /** Show the moment, or wait for its blocks and show it then, unless another is wanted by that time. */
  show() {
    if (!this.#here) return;
    const wanted = ++this.#wanted;
    const moments = this.#moments().map(({ position, motion }) => ({ position, look: this.#coloured(motion) }));
    const missing = stage.pose(moments);
    if (!missing) return this.#arrived();
    this.#late ||= setTimeout(() => this.tell('Loading …'), LATE);
    missing.then(
      () => wanted === this.#wanted && this.show(),
      () => wanted === this.#wanted && this.tell('This part of the take cannot be loaded.'),
    );
  }

  /** What `Strain.look` is told for a motion. */
  #coloured(motion) {
    if (this.#look === 'plain') return null;
    return this.#look === 'motion' ? colourOf(motion) : 'strain';
  }

  tell(sentence) {
    $('stage-note').textContent = sentence;
    $('stage-note').hidden = !sentence;
  }

  /** Say how much is here, as often as that is another number. */
  #arriving(share) {
    const sentence = `Loading the figure … ${Math.round(100 * share)} %`;
    if ($('stage-note').textContent !== sentence) this.tell(sentence);
  }

  /** Say and ask nothing more: the stage is another's. */
  #leave() {
    this.#here = false;
    this.#wanted++;
    clearTimeout(this.#late);
    clearTimeout(this.#again);
    stage?.clear();
  }

  #arrived() {
    if (!this.#late) return;
    clearTimeout(this.#late);
    this.#late = 0;
    this.tell('');
  }

  /** Without strain to show (joints alone, or rigid parts) the motions colour the figure. */
  #offerStrain({ present, gradient }) {
    const choice = (look) => document.querySelector(`#looks [value=${look}]`);
    choice('strain').parentElement.hidden = $('heat').hidden = !present;
    $('heat').querySelector('i').style.background = gradient;
    if (!present && choice('strain').checked) {
      choice('motion').checked = true;
      this.#look = 'motion';
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
