// Pointer, wheel and two fingers over the curve and the track of segments: they move the playhead, drag cuts and zoom.

import { $, onResize } from '../dom.js';
import { clockTime, frameText } from '../number_format.js';

const WHEEL = 0.0018;
const NEAR = { mouse: 5, pen: 8, touch: 14 }; // pixels from a cut that still take hold of it
const ROOM = 16; // pixels a segment has on average before its cuts can be grabbed: closer together, one would grab the wrong one

export class TimelinePointer {
  #box = $('tracks'); #head = $('playhead'); #handle = $('handle'); #hover = $('hover');
  #result; #pinch; #held = null; // 'head' or 'cut' while a pointer is down

  /** Wire the tracks of a result. */
  constructor(result, signal) {
    this.#result = result;
    this.#pinch = new Pinch(result.range);
    const on = (name, action, options = {}) => this.#box.addEventListener(name, action, { signal, ...options });
    on('pointerdown', (event) => this.#press(event));
    on('pointermove', (event) => this.#move(event));
    for (const name of ['pointerup', 'pointercancel']) on(name, (event) => this.#release(event));
    on('pointerleave', () => this.#hide());
    on('dblclick', (event) => { if (this.#cutAt(event) < 0) result.range.showAll(); });
    on('wheel', (event) => this.#wheel(event), { passive: false });
    result.range.listen(() => this.place());
    onResize(this.#box, () => this.place(), signal);
  }

  /** Put the playhead at the moment, and the handle at the selected cut. */
  place() {
    const { playhead, editor: { cut, segments } } = this.#result;
    this.#put(this.#head, playhead.frame + 0.5);
    if (cut >= 0) this.#put(this.#handle, segments[cut].end); else this.#handle.hidden = true;
    this.#box.classList.toggle('has-cut', cut >= 0);
  }

  #put(element, frame) {
    const { range, curve: { plot: { left, width } } } = this.#result;
    const share = (frame - range.from) / range.length;
    element.hidden = share < 0 || share > 1;
    element.style.transform = `translateX(${left + share * width}px)`;
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

  #press(event) {
    if (event.button) return;
    const { editor, playhead } = this.#result;
    this.#box.setPointerCapture(event.pointerId);
    this.#pinch.press(event.pointerId, this.#shareAt(event));
    if (this.#pinch.on) return this.#endDrag();
    const cut = this.#cutAt(event);
    this.#held = cut >= 0 ? 'cut' : 'head';
    if (cut >= 0) return editor.beginDrag(cut);
    editor.select(-1);
    playhead.seek(Math.floor(this.#frameAt(event)));
  }

  #move(event) {
    this.#pinch.move(event.pointerId, this.#shareAt(event));
    if (this.#pinch.on) return this.#hide();
    if (this.#held === 'head') this.#result.playhead.seek(Math.floor(this.#frameAt(event)));
    if (this.#held === 'cut') this.#result.editor.dragTo(Math.round(this.#frameAt(event)));
    this.#showHover(event);
  }

  #release(event) {
    this.#pinch.release(event.pointerId);
    this.#endDrag();
  }

  #endDrag() {
    if (this.#held === 'cut') this.#result.editor.endDrag();
    this.#held = null;
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
    const { range, editor, document: { segments } } = this.#result;
    const cut = { head: -1, cut: editor.cut }[this.#held] ?? this.#cutAt(event);
    const frame = cut >= 0 ? segments[cut].end : Math.min(range.frames - 1, Math.floor(this.#frameAt(event)));
    const segment = segments[this.#result.segmentIndexAt(frame)];
    const what = cut >= 0 ? 'cut' : segment.name + repetition(segment, frame);
    this.#box.classList.toggle('on-cut', cut >= 0);
    this.#hover.textContent = `${what} · frame ${frameText(frame)} · ${clockTime(this.#result.secondsAt(frame))}`;
    this.#hover.hidden = false;
    const { left, width } = this.#box.getBoundingClientRect();
    this.#hover.style.transform = `translateX(${Math.max(0, Math.min(width - this.#hover.offsetWidth, event.clientX - left + 12))}px)`;
  }

  #hide() {
    this.#hover.hidden = true;
    this.#box.classList.remove('on-cut');
  }
}

/** Which repetition of its motion a frame is in, in words, where there are several. */
function repetition({ repeats }, frame) {
  const at = repeats.findLastIndex(({ start }) => start <= frame);
  return repeats.length > 1 && at >= 0 ? `, ${at + 1} of ${repeats.length}` : '';
}

const CLOSE = 0.02; // share of the width below which two fingers do not zoom

/** Two fingers on a range of frames: apart and together they zoom, aside they pan. The frames under them stay under them. */
export class Pinch {
  #range; #fingers = new Map();

  constructor(range) { this.#range = range; }

  get on() { return this.#fingers.size > 1; }

  /** A finger comes down at a share of the width: from now on each holds the frame it is on. */
  press(id, share) {
    this.#fingers.set(id, { share });
    for (const finger of this.#fingers.values()) finger.frame = this.#range.from + finger.share * this.#range.length;
  }

  /** A finger moves. */
  move(id, share) {
    const finger = this.#fingers.get(id);
    if (!finger) return;
    finger.share = share;
    if (!this.on) return;
    const fingers = [...this.#fingers.values()].sort((one, other) => one.share - other.share);
    const [left, right] = [fingers[0], fingers.at(-1)]; // of three, the outer ones
    if (right.share - left.share < CLOSE || right.frame <= left.frame) return;
    const length = (right.frame - left.frame) / (right.share - left.share);
    const from = left.frame - left.share * length;
    this.#range.set(from, from + length);
  }

  release(id) { this.#fingers.delete(id); }
}
