// A result on screen: figure, curve, segments and lists, tied together by one playhead and one visible range.

import { Playhead } from './timeline/playhead.js';
import { showDetails } from './panels/method_details.js';
import { showParameters } from './panels/segmentation_form.js';
import { onFrameNumbering } from './number_format.js';
import { EnergyCurve } from './timeline/energy_curve.js';
import { $ } from './dom.js';
import { Editor } from './editing/editor.js';
import { showPoseLabels, showCounts, showMoment, showTake } from './panels/status.js';
import { KeyFrameList } from './panels/key_frame_list.js';
import { SegmentList } from './panels/segment_list.js';
import { writeTag } from './palette.js';
import { FigurePanel } from './figure/figure_panel.js';
import { ShownPoses } from './figure/shown_poses.js';
import { CutReview } from './panels/cut_review.js';
import { portraitFrame, segmentIndexAt } from './editing/segment_edits.js';
import { VisibleRange } from './timeline/visible_range.js';
import { SegmentTrack } from './timeline/segment_track.js';
import { Overview } from './timeline/overview.js';
import { Thumbnails } from './figure/thumbnails.js';
import { lookOnly } from './views.js';
import { TimelinePointer } from './timeline/pointer.js';
import { goToSegment, repeatSegment } from './timeline/navigation.js';

export class Result {
  #closing = new AbortController(); #pointer; #segment = -1; #loop = null; #list; #keyFrames; #onChange; #editing = null; #shown = new ShownPoses(this);

  /** Show `document` for the first time; `status` is its status document. `onChange()` is called after every edit. */
  constructor(document, status, onChange) {
    const { signal } = this.#closing;
    this.#onChange = onChange;
    this.figurePanel = new FigurePanel(this.#shown, signal, () => this.thumbnails.resume());
    this.playhead = new Playhead(document.frames, document.frame_rate, (frame) => this.figurePanel.ready(frame));
    this.playhead.speed = Number($('speed').value);
    this.range = new VisibleRange(document.frames);
    this.#setDocument(document);
    this.thumbnails = new Thumbnails(() => this.figurePanel.dressedScene, () => this.playhead.playing, signal);
    this.#list = new SegmentList(this);
    this.#keyFrames = new KeyFrameList(this, signal);
    this.curve = new EnergyCurve($('curve'), document, this.range, signal);
    const picture = (frame, whenDrawn) => this.thumbnails.of(frame, whenDrawn);
    this.segmentTrack = new SegmentTrack($('timeline'), document, this.range, () => this.curve.plot, picture, signal);
    this.overview = new Overview($('overview'), document, this.range, () => this.curve.plot, signal);
    this.labelTrack = null; // until a person compares
    this.#pointer = new TimelinePointer(this, signal);
    this.#startEditing(document, status);
    this.playhead.listen(() => (this.#hasLeftCut() ? this.editor.select(-1) : this.#showMoment()));
    onFrameNumbering(() => this.#renumber(), signal);
  }

  /** Another cut of the same take: everything but the figure, the playhead and the zoom changes. */
  show(document, status) {
    this.playhead.loop = null;
    this.#setDocument(document);
    this.curve.show(document);
    this.segmentTrack.show(document);
    this.overview.show(document);
    this.labelTrack?.show(document);
    this.#startEditing(document, status);
  }

  /** The same result with edited segments. */
  edited(document) {
    this.#setDocument(document);
    this.curve.edited(document);
    this.segmentTrack.show(document);
    this.overview.show(document);
    this.labelTrack?.show(document);
    this.#list.show(document);
    this.#keyFrames.show(document);
    this.#showDetails();
    showCounts(document);
    this.#showMoment();
  }

  /** A cut is selected, or none (-1). */
  selected(cut) {
    document.body.classList.toggle('cut-selected', cut >= 0);
    this.#showMoment();
  }

  /** Segments are chosen: the indices of those that edits are for. */
  chosen(indices) {
    this.#list.choose(indices);
    this.segmentTrack.select(indices);
  }

  goToSegment(index) {
    this.editor.chooseOnly([]);
    goToSegment(this, index);
  }

  /** Choose all segments from the current one to the one whose row has the focus. */
  chooseToFocus() { if (this.#list.focused >= 0) this.editor.chooseTo(this.#list.focused); }

  /** Compare with the labels of a file, on a track of their own. */
  async compareWith(file) {
    const { LabelTrack } = await import('./labels/label_track.js');
    if (this.closed) return;
    this.labelTrack ??= new LabelTrack(this.document, this.range, () => this.curve.plot, this.#closing.signal);
    this.labelTrack.open(file);
  }

  arrangeList(by) { this.#list.arrange(by); }

  /** Leave the page to another take. */
  close() {
    this.playhead.toggle(false);
    this.editor.close();
    showPoseLabels(null);
    this.#editing.abort();
    this.#closing.abort();
  }

  /** Whether the page shows another result by now. */
  get closed() { return this.#closing.signal.aborted; }

  /** The index of the segment that a frame is in. */
  segmentIndexAt(frame) { return segmentIndexAt(this.document.segments, frame); }

  /** Seconds of a frame on the file's own clock. */
  secondsAt(frame) { return this.document.source.start_seconds + frame / this.document.frame_rate; }

  /** Seconds of the current frame. */
  get seconds() { return this.secondsAt(this.playhead.frame); }

  #setDocument(document) {
    this.document = document;
    this.#segment = -1;
  }

  /** Begin to edit a document; editing the one before ends. */
  #startEditing(document, status) {
    this.status = status;
    this.thumbnails.open(document.id, portraitFrame(longestOf(document.segments)), lookOnly());
    this.#editing?.abort();
    this.#editing = new AbortController();
    this.editor?.close();
    this.editor = new Editor(this, { newest: status.revision, fixed: lookOnly(), onChange: () => { this.review.show(); this.#pointer.place(); this.#onChange(); } });
    this.review = new CutReview(document, this.editor, this.playhead, this.range, this.#editing.signal);
    showTake(document);
    showCounts(document);
    this.#list.show(document);
    this.#keyFrames.show(document);
    showParameters(document, status.motions);
    this.#showDetails();
    this.review.show();
    this.selected(-1);
    this.#onChange();
  }

  #showDetails() {
    showDetails(this.document, (frame) => { this.playhead.seek(frame); this.range.reveal(frame); });
  }

  /** Frames are counted from the other number. */
  #renumber() {
    this.#list.show(this.document);
    this.curve.refresh();
    this.#showMoment();
  }

  /** Whether the playhead has left the selected cut. Playing around a cut does not leave it. */
  #hasLeftCut() { return this.#shown.pair !== null && this.playhead.frame !== this.#shown.pair[0].end; }

  /** Show the current frame: the playhead has moved, or what is around it has changed. */
  #showMoment() {
    const { playhead } = this;
    const index = this.segmentIndexAt(playhead.frame);
    if (playhead.playing) this.range.follow(playhead.frame);
    if (!playhead.loop && !playhead.until && $('loop').checked) repeatSegment(this, true);
    this.#pointer.place();
    if (index !== this.#segment) this.#enterSegment(index);
    if (playhead.loop !== this.#loop) {
      this.#loop = playhead.loop;
      this.#onChange();
    }
    showMoment(this, this.document.segments[index], this.#shown.labels);
    this.figurePanel.show();
  }

  #enterSegment(index) {
    this.#segment = index;
    this.#list.mark(index);
    this.segmentTrack.mark(index);
    writeTag($('now-motion'), this.document.segments[index]);
    this.#onChange();
  }
}

/** The segment that stands for a take: the longest of those that are kept. */
function longestOf(segments) {
  const kept = segments.filter(({ discard }) => !discard);
  return (kept.length ? kept : segments).reduce((best, one) => (one.end - one.start > best.end - best.start ? one : best));
}
