// Pointer and wheel over the curve and the track of segments: they move the playhead, drag cuts and zoom.

import { $, onResize } from '../dom.js';
import { CutDrag } from './cut_drag.js';
import { TimelineHover } from './hover.js';
import { nearestKeyFrame, snappedFrame } from './key_frames.js';
import { zoomToSegment } from './navigation.js';
import { Pinch } from './pinch.js';
import { placeTools } from './selection_tools_place.js';

const WHEEL = 0.0018;
const NEAR = { mouse: 5, pen: 8, touch: 14 }; // pixels from a cut that still take hold of it
const SNAP = 14; // pixels from which a cut snaps
const ROOM = 16; // pixels a segment has on average before its cuts can be grabbed: closer together, one would grab the wrong one

export class TimelinePointer {
  #box = $('tracks'); #head = $('playhead'); #handle = $('handle'); #toolsAt = null;
  #result; #hover; #pinch; #scrubs = false; #drag = null; // while a pointer is down

  /** Wire the tracks of a result. */
  constructor(result, signal) {
    this.#result = result;
    this.#hover = new TimelineHover(result);
    this.#pinch = new Pinch(result.range);
    const on = (name, action, options = {}) => this.#box.addEventListener(name, action, { signal, ...options });
    on('pointerdown', (event) => this.#press(event));
    on('pointermove', (event) => this.#move(event));
    on('pointerup', (event) => this.#release(event, (drag) => drag.end()));
    on('pointercancel', (event) => this.#release(event, (drag) => drag.cancel()));
    on('pointerleave', () => this.#hide());
    on('dblclick', (event) => { if (this.#cutAt(event) < 0) zoomToSegment(result, Math.floor(this.#frameAt(event))); });
    on('wheel', (event) => this.#wheel(event), { passive: false });
    result.range.listen(() => this.place());
    onResize(this.#box, () => this.place(), signal);
    onResize($('selection-tools'), () => { this.#toolsAt = null; this.#placeTools(); }, signal);
  }

  /** Put the playhead at the moment, and the handle at the selected cut. */
  place() {
    const { playhead, editor: { cut, segments } } = this.#result;
    this.#put(this.#head, playhead.frame + 0.5);
    if (cut >= 0) this.#put(this.#handle, segments[cut].end); else this.#handle.hidden = true;
    this.#box.classList.toggle('has-cut', cut >= 0);
    this.#placeTools();
  }

  /** Put the tools under the selected cut, or under what is seen of the current segment; while it plays they stay. */
  #placeTools() {
    const { playhead, range, editor: { cut, segments, currentIndex } } = this.#result;
    if (playhead.playing) return;
    const { start, end } = segments[currentIndex];
    const x = this.#x(cut >= 0 ? segments[cut].end : (Math.max(start, range.from) + Math.min(end, range.to)) / 2);
    if (x === this.#toolsAt) return; // placing them makes the browser lay out the page
    this.#toolsAt = x;
    placeTools(x);
  }

  /** Where a frame is, in pixels of the tracks. */
  #x(frame) {
    const { range, curve: { plot: { left, width } } } = this.#result;
    return left + ((frame - range.from) / range.length) * width;
  }

  #put(element, frame) {
    const { range } = this.#result;
    element.hidden = frame < range.from || frame > range.to;
    element.style.transform = `translateX(${this.#x(frame)}px)`;
  }

  /** Where a pointer is: 0 at the left of the plot, 1 at its right. */
  #shareAt({ clientX }) {
    const { left, width } = this.#result.curve.plot;
    return Math.max(0, Math.min(1, (clientX - this.#box.getBoundingClientRect().left - left) / width));
  }

  #frameAt(event) {
    const { range } = this.#result;
    return range.from + this.#shareAt(event) * range.length;
  }

  /** The cut under a pointer, or -1. */
  #cutAt(event) {
    const { range, document: { segments }, curve: { plot: { width } } } = this.#result;
    const visible = this.#result.segmentIndexAt(range.to) - this.#result.segmentIndexAt(range.from) + 1;
    if (visible * ROOM > width) return -1;
    const frame = this.#frameAt(event);
    const index = this.#result.segmentIndexAt(Math.min(range.frames - 1, Math.floor(frame)));
    const [near] = [index - 1, index].filter((cut) => cut >= 0 && cut < segments.length - 1)
      .map((cut) => ({ cut, away: (Math.abs(segments[cut].end - frame) * width) / range.length }))
      .sort((one, other) => one.away - other.away);
    return near && near.away <= (NEAR[event.pointerType] || NEAR.mouse) ? near.cut : -1;
  }

  /** The key-frame under a pointer, or null. */
  #keyAt(event) {
    const { range, document, curve: { plot: { width } } } = this.#result;
    return nearestKeyFrame(document.key_frames, this.#frameAt(event), ((NEAR[event.pointerType] || NEAR.mouse) * range.length) / width);
  }

  #press(event) {
    if (event.button) return;
    const { editor, playhead } = this.#result;
    this.#box.setPointerCapture(event.pointerId);
    this.#pinch.press(event.pointerId, this.#shareAt(event));
    if (this.#pinch.on) return this.#letGo((drag) => drag.cancel());
    const cut = this.#cutAt(event);
    if (cut >= 0) {
      this.#drag = new CutDrag(editor, cut, event, () => { this.#drag = null; });
      return;
    }
    this.#scrubs = true;
    editor.select(-1);
    editor.chooseOnly([]);
    playhead.seek(this.#keyAt(event)?.frame ?? Math.floor(this.#frameAt(event)));
  }

  #move(event) {
    this.#pinch.move(event.pointerId, this.#shareAt(event));
    if (this.#pinch.on) return this.#hide();
    if (this.#scrubs) this.#result.playhead.seek(Math.floor(this.#frameAt(event)));
    const perPixel = this.#result.range.length / this.#result.curve.plot.width;
    const snap = event.ctrlKey || event.metaKey ? (frame) => snappedFrame(this.#result.document, frame, SNAP * perPixel) : (frame) => frame;
    this.#drag?.moveTo(event.clientX, perPixel, snap);
    this.#showHover(event);
  }

  #release(event, finish) {
    this.#pinch.release(event.pointerId);
    this.#letGo(finish);
  }

  #letGo(finish) {
    if (this.#drag) finish(this.#drag);
    this.#drag = null;
    this.#scrubs = false;
  }

  #wheel(event) {
    const { range } = this.#result;
    event.preventDefault();
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      range.pan(((event.deltaX || event.deltaY) / this.#result.curve.plot.width) * range.length);
    } else range.zoom(Math.exp(-event.deltaY * WHEEL), this.#frameAt(event));
  }

  /** Say what is under the pointer, or where the cut is that it drags. */
  #showHover(event) {
    const { range, document: { segments } } = this.#result;
    const cut = this.#scrubs ? -1 : this.#drag?.cut ?? this.#cutAt(event);
    const key = this.#drag || this.#scrubs || cut >= 0 ? null : this.#keyAt(event);
    const frame = cut >= 0 ? segments[cut].end : key?.frame ?? Math.min(range.frames - 1, Math.floor(this.#frameAt(event)));
    this.#box.classList.toggle('on-cut', cut >= 0);
    this.#box.classList.toggle('on-key', key !== null);
    this.#hover.show(event.clientX - this.#box.getBoundingClientRect().left, { frame, cut: cut >= 0, key: key !== null });
  }

  #hide() {
    this.#hover.hide();
    this.#box.classList.remove('on-cut', 'on-key');
  }
}
