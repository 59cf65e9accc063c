// A result on screen: the curve, the timeline, the lists and the figure, tied together by one clock and one span.

import { Clock } from './clock.js';
import { reflect } from './controls.js';
import { numberOf, onCounting, shownFrame } from './counting.js';
import { Curve } from './curve.js';
import { $, make } from './dom.js';
import { Editor } from './editor.js';
import { SegmentList } from './motions.js';
import { clock as clockTime, count, whole } from './numbers.js';
import { captions } from './pair.js';
import { tagged } from './palette.js';
import { Presence } from './presence.js';
import { Review } from './review.js';
import { Span } from './span.js';
import { Timeline } from './timeline.js';
import { tracks } from './tracks.js';

export class Result {
  #gone = new AbortController(); #place; #segment = -1; #ends = []; #list; #listener; #work = null;

  /** Lay out `document` for the first time; `newest` is its newest revision. `onChange()` hears of every edit. */
  constructor(document, newest, onChange) {
    const { signal } = this.#gone;
    this.#listener = onChange;
    this.presence = new Presence(() => this.#moments(), signal);
    this.clock = new Clock(document.frames, document.frame_rate, (frame) => this.presence.ready(frame));
    this.clock.speed = Number($('speed').value);
    this.span = new Span(document.frames);
    this.#list = new SegmentList((index) => this.go(index));
    this.#take(document);
    this.curve = new Curve($('curve'), document, this.span, signal);
    this.timeline = new Timeline($('timeline'), document, this.span, () => this.curve.plot, signal);
    this.#place = tracks(this, signal);
    this.#open(document, newest);
    this.clock.listen(() => (this.#hasLeftCut() ? this.editor.select(-1) : this.#moment()));
    onCounting(() => this.#recount(), signal);
  }

  /** Another cut of the same take: everything but the figure, the moment and the zoom changes. */
  show(document, newest) {
    this.clock.loop = null;
    this.#take(document);
    this.curve.show(document);
    this.timeline.show(document);
    this.#open(document, newest);
  }

  /** The same result with edited segments. */
  edited(document) {
    this.#take(document);
    this.curve.edited(document);
    this.timeline.show(document);
    this.#list.show(document);
    this.#summary();
    this.#moment();
  }

  /** A cut was selected, or let go of (-1). */
  selected(cut) {
    document.body.classList.toggle('cut-selected', cut >= 0);
    if (cut >= 0) $('edit').scrollLeft = $('cut-before').offsetLeft - $('edit').offsetLeft; // on a phone the row is wider than the screen
    this.#moment();
  }

  /** Leave the page to another take. */
  close() {
    this.clock.toggle(false);
    this.editor.close();
    captions(null);
    this.#work.abort();
    this.#gone.abort();
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

  /** How many segments are on screen. */
  visible() { return this.indexAt(this.span.to) - this.indexAt(this.span.from) + 1; }

  /** Seconds of a frame on the file's own clock. */
  seconds(frame) { return this.document.source.start_seconds + frame / this.document.frame_rate; }

  go(index) {
    const segment = this.document.segments[index];
    if (!segment) return;
    this.editor.select(-1);
    this.clock.seek(segment.start);
    if ($('loop').checked) this.clock.loop = [segment.start, segment.end];
    this.span.reveal(segment.start);
  }

  /** To the segment before or after. Going back from within one goes to its own start first. */
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

  /** Begin to edit a document; what was worked on before is over. */
  #open(document, newest) {
    this.#work?.abort();
    this.#work = new AbortController();
    this.editor?.close();
    this.editor = new Editor(this, { newest, onChange: () => { this.review.show(); this.#place(); this.#listener(); } });
    this.review = new Review(document.id, this.editor, this.clock, this.span, this.#work.signal);
    this.#say(document);
    this.review.show();
    this.selected(-1);
    this.#listener();
  }

  /** What does not move: counts, lists, links. */
  #say(document) {
    $('frames').textContent = whole(document.frames);
    $('frame').size = Math.max(3, String(document.frames).length);
    $('cut-frame').size = $('frame').size;
    $('timeline').setAttribute('aria-valuemax', document.frames - 1);
    this.#list.show(document);
    this.#summary();
    const warnings = $('warnings');
    warnings.hidden = !document.warnings.length;
    warnings.querySelector('summary').textContent = count(document.warnings.length, 'thing to know', 'things to know');
    warnings.querySelector('ul').replaceChildren(...document.warnings.map((warning) => make('li', {}, warning.detail)));
    reflect(document);
  }

  #summary() {
    const { motions, segments } = this.document;
    $('summary').textContent = `${count(motions, 'motion')} · ${count(segments.length, 'segment')}`;
  }

  /** Numbers are counted the other way. */
  #recount() {
    this.#list.show(this.document);
    this.curve.refresh();
    this.#moment();
  }

  /** What the figure shows: the moment, or the two sides of the selected cut. */
  #moments() {
    const { clock, editor } = this;
    const { segments } = this.document;
    if (editor?.cut >= 0 && !clock.playing) {
      const [before, after] = [segments[editor.cut], segments[editor.cut + 1]];
      return [{ position: before.end - 1, motion: before.motion }, { position: after.start, motion: after.motion }];
    }
    // Paused: the frame's own pose. Playing: between two frames too, so that it is smooth on a fast screen.
    return [{ position: clock.playing ? clock.position : clock.frame, motion: segments[this.indexAt(clock.frame)].motion }];
  }

  /** Whether the moment has gone elsewhere than the selected cut. Playing around it is not leaving it. */
  #hasLeftCut() {
    const { cut } = this.editor;
    return cut >= 0 && !this.clock.playing && this.clock.frame !== this.document.segments[cut].end;
  }

  /** What moves with the clock. */
  #moment() {
    const { clock, editor } = this;
    const { frame } = clock;
    const index = this.indexAt(frame);
    const cut = editor?.cut ?? -1;
    if (clock.playing) this.#follow(frame);
    if (!clock.loop && !clock.until && $('loop').checked) this.loop(true);
    this.#place();
    const field = $('frame');
    if (field !== window.document.activeElement) field.value = numberOf(frame);
    $('seconds').textContent = clockTime(this.seconds(frame));
    const energy = this.document.energy[frame];
    $('nats').textContent = energy === null || energy === undefined ? '' : `${energy.toFixed(3)} nats`;
    document.body.classList.toggle('playing', clock.playing);
    $('play').setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
    if (index !== this.#segment) this.#enter(index);
    const two = cut >= 0 && !clock.playing;
    captions(...(two ? [this.document.segments[cut], this.document.segments[cut + 1]] : [null]));
    $('timeline').setAttribute('aria-valuenow', frame);
    $('timeline').setAttribute('aria-valuetext', `frame ${shownFrame(frame)}, motion ${this.document.segments[index].name}`);
    this.presence.show();
  }

  #enter(index) {
    this.#segment = index;
    this.#list.mark(index);
    this.timeline.mark(index);
    tagged($('now-motion'), this.document.segments[index]);
    this.#listener();
  }

  /** While it plays, the span moves on by pages: a curve that crawls cannot be read. */
  #follow(frame) {
    const { span } = this;
    if (frame >= span.to - 1 && span.to < span.frames) span.set(frame, frame + span.length);
    else if (frame < span.from) span.set(frame, frame + span.length);
  }
}
