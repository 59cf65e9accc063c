// A result on screen: the curve, the timeline, the lists and the figure, tied together by one clock and one span.

import { Clock } from './timeline/playhead.js';
import { reflect } from './panels/segmentation_form.js';
import { onCounting } from './number_format.js';
import { Curve } from './timeline/energy_curve.js';
import { $ } from './dom.js';
import { Editor } from './editing/editor.js';
import { captions, tellCounts, tellMoment, tellTake } from './panels/status.js';
import { SegmentList } from './panels/segment_list.js';
import { tagged } from './palette.js';
import { Presence } from './figure/figure_panel.js';
import { Review } from './panels/cut_review.js';
import { indexAt } from './editing/segment_edits.js';
import { Span } from './timeline/visible_range.js';
import { Timeline } from './timeline/segment_track.js';
import { Tracks } from './timeline/pointer.js';
import { goTo, loop } from './timeline/navigation.js';

export class Result {
  #gone = new AbortController(); #tracks; #segment = -1; #list; #listener; #work = null;

  /** Lay out `document` for the first time; `status` is the service's word of it. `onChange()` hears of every edit. */
  constructor(document, status, onChange) {
    const { signal } = this.#gone;
    this.#listener = onChange;
    this.presence = new Presence(() => this.#moments(), signal);
    this.clock = new Clock(document.frames, document.frame_rate, (frame) => this.presence.ready(frame));
    this.clock.speed = Number($('speed').value);
    this.span = new Span(document.frames);
    this.#list = new SegmentList((index) => goTo(this, index));
    this.#take(document);
    this.curve = new Curve($('curve'), document, this.span, signal);
    this.timeline = new Timeline($('timeline'), document, this.span, () => this.curve.plot, signal);
    this.#tracks = new Tracks(this, signal);
    this.#open(document, status);
    this.clock.listen(() => (this.#hasLeftCut() ? this.editor.select(-1) : this.#moment()));
    onCounting(() => this.#recount(), signal);
  }

  /** Another cut of the same take: everything but the figure, the moment and the zoom changes. */
  show(document, status) {
    this.clock.loop = null;
    this.#take(document);
    this.curve.show(document);
    this.timeline.show(document);
    this.#open(document, status);
  }

  /** The same result with edited segments. */
  edited(document) {
    this.#take(document);
    this.curve.edited(document);
    this.timeline.show(document);
    this.#list.show(document);
    tellCounts(document);
    this.#moment();
  }

  /** A cut was selected, or let go of (-1). */
  selected(cut) {
    document.body.classList.toggle('cut-selected', cut >= 0);
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

  /** Whether the page shows another by now. */
  get closed() { return this.#gone.signal.aborted; }

  /** The segment a frame is in, by its place. */
  indexAt(frame) { return indexAt(this.document.segments, frame); }

  /** Seconds of a frame on the file's own clock. */
  secondsAt(frame) { return this.document.source.start_seconds + frame / this.document.frame_rate; }

  /** Seconds of the moment. */
  get seconds() { return this.secondsAt(this.clock.frame); }

  #take(document) {
    this.document = document;
    this.#segment = -1;
  }

  /** Begin to edit a document; what was worked on before is over. */
  #open(document, status) {
    this.status = status;
    this.#work?.abort();
    this.#work = new AbortController();
    this.editor?.close();
    this.editor = new Editor(this, { newest: status.revision, onChange: () => { this.review.show(); this.#tracks.place(); this.#listener(); } });
    this.review = new Review(document.id, this.editor, this.clock, this.span, this.#work.signal);
    tellTake(document);
    tellCounts(document);
    this.#list.show(document);
    reflect(document);
    this.review.show();
    this.selected(-1);
    this.#listener();
  }

  /** Numbers are counted the other way. */
  #recount() {
    this.#list.show(this.document);
    this.curve.refresh();
    this.#moment();
  }

  /** The segments on both sides of the selected cut, while they are compared; else null. */
  get #pair() {
    const { cut } = this.editor;
    return cut >= 0 && !this.clock.playing ? this.document.segments.slice(cut, cut + 2) : null;
  }

  /** What the figure shows: the moment, or the two sides of the selected cut. */
  #moments() {
    const { clock } = this;
    if (this.#pair) {
      const [before, after] = this.#pair;
      return [{ position: before.end - 1, motion: before.motion }, { position: after.start, motion: after.motion }];
    }
    // Paused: the frame's own pose. Playing: between two frames too, so that it is smooth on a fast screen.
    const { motion } = this.document.segments[this.indexAt(clock.frame)];
    return [{ position: clock.playing ? clock.position : clock.frame, motion }];
  }

  /** Whether the moment has gone elsewhere than the selected cut. Playing around it is not leaving it. */
  #hasLeftCut() { return this.#pair !== null && this.clock.frame !== this.#pair[0].end; }

  /** The clock has moved, or what is around it has changed. */
  #moment() {
    const { clock } = this;
    const index = this.indexAt(clock.frame);
    if (clock.playing) this.span.follow(clock.frame);
    if (!clock.loop && !clock.until && $('loop').checked) loop(this, true);
    this.#tracks.place();
    if (index !== this.#segment) this.#enter(index);
    tellMoment(this, this.document.segments[index], this.#pair);
    this.presence.show();
  }

  #enter(index) {
    this.#segment = index;
    this.#list.mark(index);
    this.timeline.mark(index);
    tagged($('now-motion'), this.document.segments[index]);
    this.#listener();
  }
}
