// A result on screen: the curve, the timeline, the list and the figure, tied together by one clock and one span.

import * as api from './api.js';
import { Clock } from './clock.js';
import { note, reflect } from './controls.js';
import { Curve } from './curve.js';
import { $, make } from './dom.js';
import { listed } from './motions.js';
import { clock as clockTime, count, duration, rate, whole } from './numbers.js';
import { colourOf, inkOn } from './palette.js';
import { HEAT } from './heat.js';
import { Span } from './span.js';
import { Timeline } from './timeline.js';
import { tracks } from './tracks.js';

let stage = null; // one for the page: a browser gives out few WebGL contexts

const LATE = 250; // ms after which a wait for blocks is said

export class Result {
  #gone = new AbortController(); #stage = null; #wanted = null; #mark; #place; #segment = -1; #look = 'strain'; #late = 0; #ends = [];

  /** Lay out `document` for the first time. */
  constructor(document) {
    const { signal } = this.#gone;
    this.clock = new Clock(document.frames, document.frame_rate, (frame) => this.#ready(frame));
    this.clock.speed = Number($('speed').value);
    this.span = new Span(document.frames);
    this.#take(document);
    this.curve = new Curve($('curve'), document, this.span, signal);
    const plot = () => this.curve.plot;
    this.timeline = new Timeline($('timeline'), document, this.span, plot, signal);
    this.#place = tracks({
      span: this.span, clock: this.clock, plot,
      segmentAt: (frame) => this.document.segments[this.indexAt(frame)],
      seconds: (frame) => this.#seconds(frame),
      signal,
    });
    this.#say(document);
    this.clock.listen(() => this.#moment());
    this.#moment();
  }

  /** Another cut of the same take: everything but the figure, the moment and the zoom changes. */
  show(document) {
    this.#take(document);
    this.curve.show(document);
    this.timeline.show(document);
    this.#say(document);
    this.clock.loop = null;
    this.#moment();
  }

  /** Leave the page to another take. */
  close() {
    this.clock.toggle(false);
    this.#gone.abort();
    this.#stage?.clear();
    this.#stage = null;
  }

  /** Bring the figure onto the stage; without it the rest of the page works all the same. */
  async figure() {
    try {
      this.#tell('Loading the figure …');
      const viewer = await api.viewer(this.document.id);
      const { Stage } = await import('./stage.js');
      stage ||= new Stage($('figure'));
      await stage.show(viewer, this.#gone.signal, (share) => this.#tell(`Loading the figure … ${Math.round(100 * share)} %`));
      if (this.#gone.signal.aborted) return;
      this.#stage = stage;
      this.#tell('');
      $('upright').hidden = viewer.kind !== 'vertices';
      this.#offerStrain(this.#stage.strain.present);
      this.#stage.canvas.dataset.shown = viewer.kind;
      this.#moment();
    } catch (problem) {
      if (this.#gone.signal.aborted) return;
      this.#tell(problem.document?.code === 'not-finished'
        ? 'The figure is still being prepared.' : `The figure cannot be shown: ${problem.message}`);
      if (problem.document?.code === 'not-finished') setTimeout(() => this.figure(), 1500);
    }
  }

  get stage() { return this.#stage; }

  look(choice) {
    this.#look = choice;
    $('heat').classList.toggle('off', choice !== 'strain');
    this.#moment();
  }

  /** Without strain to show (joints alone, or rigid parts) the motions colour the figure. */
  #offerStrain(present) {
    const choice = (look) => document.querySelector(`#looks [value=${look}]`);
    choice('strain').parentElement.hidden = $('heat').hidden = !present;
    if (!present && choice('strain').checked) {
      choice('motion').checked = true;
      this.#look = 'motion';
    }
  }

  /** The segment a frame is in. */
  indexAt(frame) {
    let low = 0;
    let high = this.#ends.length - 1;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (frame < this.#ends[middle]) high = middle; else low = middle + 1;
    }
    return low;
  }

  go(index) {
    const segment = this.document.segments[index];
    if (!segment) return;
    this.clock.seek(segment.start);
    if ($('loop').checked) this.clock.loop = [segment.start, segment.end];
    this.span.reveal(segment.start);
  }

  /** To the cut before or after. Going back from within a segment goes to its own start first. */
  jump(by) {
    const index = this.indexAt(this.clock.frame);
    const started = this.clock.frame - this.document.segments[index].start > this.clock.rate / 2;
    this.go(by < 0 && started ? index : Math.max(0, Math.min(this.document.segments.length - 1, index + by)));
  }

  loop(on) {
    const segment = this.document.segments[this.indexAt(this.clock.frame)];
    this.clock.loop = on ? [segment.start, segment.end] : null;
  }

  #take(document) {
    this.document = document;
    this.#ends = document.segments.map((segment) => segment.end);
    this.#segment = -1;
  }

  #seconds(frame) { return this.document.source.start_seconds + frame / this.document.frame_rate; }

  /** Clips are made at the first request: wait until they are there, then let the browser save them. */
  async #saveClips(event, id) {
    event.preventDefault();
    note('Writing the clips…');
    try {
      while (!(await api.clipsReady(id)));
      note('');
      window.location.assign(api.clips(id));
    } catch (problem) {
      note(problem.message);
    }
  }

  /** What does not move: counts, lists, links. */
  #say(document) {
    $('frames').textContent = whole(document.frames);
    $('frame').size = Math.max(3, String(document.frames).length);
    $('timeline').setAttribute('aria-valuemax', document.frames - 1);
    $('summary').textContent = `${count(document.motions, 'motion')} · ${count(document.segments.length, 'segment')}`;
    this.#mark = listed(document, (index) => this.go(index));
    for (const link of $('downloads').querySelectorAll('a[data-form]')) {
      link.href = api.download(document.id, link.dataset.form);
      link.download = `${document.id}.${link.dataset.form}`;
    }
    $('clips').href = api.clips(document.id);
    $('clips').onclick = (event) => this.#saveClips(event, document.id);
    const warnings = $('warnings');
    warnings.hidden = !document.warnings.length;
    warnings.querySelector('summary').textContent = count(document.warnings.length, 'thing to know', 'things to know');
    warnings.querySelector('ul').replaceChildren(...document.warnings.map((warning) => make('li', {}, warning.detail)));
    reflect(document);
    note('');
  }

  /** What moves with the clock. */
  #moment() {
    const { clock } = this;
    const frame = clock.frame;
    const index = this.indexAt(frame);
    if (clock.playing) this.#follow(frame);
    if (!clock.loop && $('loop').checked) this.loop(true);
    this.#place();
    const field = $('frame');
    if (field !== window.document.activeElement) field.value = frame;
    $('seconds').textContent = clockTime(this.#seconds(frame));
    const energy = this.document.energy[frame];
    $('nats').textContent = energy === null || energy === undefined ? '' : `${energy.toFixed(3)} nats`;
    document.body.classList.toggle('playing', clock.playing);
    if (index !== this.#segment) this.#enter(index);
    $('timeline').setAttribute('aria-valuenow', frame);
    $('timeline').setAttribute('aria-valuetext', `frame ${frame}, motion ${this.document.segments[index].name}`);
    if (!this.#stage?.figure) return;
    const colour = this.#look === 'motion' ? colourOf(this.document.segments[index].motion) : this.#look === 'strain' ? 'strain' : null;
    this.#stage.strain.look(colour);
    // Paused: the frame's own pose. Playing: between two frames too, so that it is smooth on a fast screen.
    this.#show(clock.playing ? clock.position : frame);
  }

  #show(position) {
    const frame = Math.floor(position);
    const { figure, strain } = this.#stage;
    this.#wanted = frame;
    const here = figure.ready(frame);
    const coloured = this.#stage.pose(position);
    if (here && coloured) return this.#arrived();
    this.#late ||= setTimeout(() => this.#tell('Loading …'), LATE);
    // What was scrubbed past meanwhile is of no interest any more.
    Promise.all([figure.fetch(frame), strain.fetch(frame)]).then(
      () => frame === this.#wanted && this.#show(position),
      () => frame === this.#wanted && this.#tell('This part of the take cannot be loaded.'),
    );
  }

  #arrived() {
    if (!this.#late) return;
    clearTimeout(this.#late);
    this.#late = 0;
    this.#tell('');
  }

  #ready(frame) { return !this.#stage?.figure || this.#stage.figure.ready(frame); }

  #enter(index) {
    this.#segment = index;
    const segment = this.document.segments[index];
    this.#mark(index);
    this.timeline.mark(index);
    const tag = $('now-motion');
    tag.textContent = segment.name;
    tag.style.background = colourOf(segment.motion);
    tag.style.color = inkOn(colourOf(segment.motion));
  }

  /** While it plays, the span moves on by pages: a curve that crawls cannot be read. */
  #follow(frame) {
    const { span } = this;
    if (frame >= span.to - 1 && span.to < span.frames) span.set(frame, frame + span.length);
    else if (frame < span.from) span.set(frame, frame + span.length);
  }

  #tell(sentence) {
    $('stage-note').textContent = sentence;
    $('stage-note').hidden = !sentence;
  }
}

/** One line about the take, for the top of the page. */
export const about = (document) => [
  document.source.name, count(document.frames, 'frame'), rate(document.frame_rate), duration(document.duration_seconds),
].filter(Boolean).join(' · ');

/** The key to the heat colours. */
export function drawHeatKey() {
  const canvas = $('heat').querySelector('canvas');
  const context = canvas.getContext('2d');
  const ramp = context.createLinearGradient(0, 0, canvas.width, 0);
  HEAT.forEach((colour, i) => ramp.addColorStop(i / (HEAT.length - 1), colour));
  context.fillStyle = ramp;
  context.fillRect(0, 0, canvas.width, 1);
}
