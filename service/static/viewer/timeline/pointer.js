// Pointer and wheel over the curve and the timeline: the playhead that runs through both, and cuts to be dragged.

import { $, onResize } from '../dom.js';
import { clock as clockTime, shownFrame } from '../number_format.js';

const WHEEL = 0.0018;
const NEAR = { mouse: 5, pen: 8, touch: 14 }; // pixels from a cut that still take hold of it
const ROOM = 16; // pixels a segment has on average before its cuts can be grabbed: closer together, one would grab the wrong one

export class Tracks {
  #box = $('tracks'); #head = $('playhead'); #handle = $('handle'); #hover = $('hover');
  #result; #pinch; #held = null; // 'head' or 'cut' while a pointer is down

  /** Wire the tracks of a result. */
  constructor(result, signal) {
    this.#result = result;
    this.#pinch = new Pinch(result.span);
    const on = (name, action, options = {}) => this.#box.addEventListener(name, action, { signal, ...options });
    on('pointerdown', (event) => this.#press(event));
    on('pointermove', (event) => this.#move(event));
    for (const name of ['pointerup', 'pointercancel']) on(name, (event) => this.#release(event));
    on('pointerleave', () => this.#hide());
    on('dblclick', (event) => { if (this.#cutAt(event) < 0) result.span.all(); });
    on('wheel', (event) => this.#wheel(event), { passive: false });
    result.span.listen(() => this.place());
    onResize(this.#box, () => this.place(), signal);
  }

  /** Put the playhead at the moment, and the handle at the selected cut. */
  place() {
    const { clock, editor: { cut, segments } } = this.#result;
    this.#put(this.#head, clock.frame + 0.5);
    if (cut >= 0) this.#put(this.#handle, segments[cut].end); else this.#handle.hidden = true;
    this.#box.classList.toggle('has-cut', cut >= 0);
  }

  #put(element, frame) {
    const { span, curve: { plot: { left, width } } } = this.#result;
    const share = (frame - span.from) / span.length;
    element.hidden = share < 0 || share > 1;
    element.style.transform = `translateX(${left + share * width}px)`;
  }

  /** Where a pointer is: 0 at the left of the plot, 1 at its right. */
  #shareAt({ clientX }) {
    const { left, width } = this.#result.curve.plot;
    return Math.max(0, Math.min(1, (clientX - this.#box.getBoundingClientRect().left - left) / width));
  }

  #frameAt(event) {
    const { span } = this.#result;
    return span.from + this.#shareAt(event) * span.length;
  }

  /** The cut under a pointer, or -1. */
  #cutAt(event) {
    const { span, document: { segments }, curve: { plot: { width } } } = this.#result;
    const visible = this.#result.indexAt(span.to) - this.#result.indexAt(span.from) + 1;
    if (visible * ROOM > width) return -1;
    const frame = this.#frameAt(event);
    const index = this.#result.indexAt(Math.min(span.frames - 1, Math.floor(frame)));
    const [near] = [index - 1, index].filter((cut) => cut >= 0 && cut < segments.length - 1)
      .map((cut) => ({ cut, away: (Math.abs(segments[cut].end - frame) * width) / span.length }))
      .sort((one, other) => one.away - other.away);
    return near && near.away <= (NEAR[event.pointerType] || NEAR.mouse) ? near.cut : -1;
  }

  #press(event) {
    if (event.button) return;
    const { editor, clock } = this.#result;
    this.#box.setPointerCapture(event.pointerId);
    this.#pinch.press(event.pointerId, this.#shareAt(event));
    if (this.#pinch.on) return this.#letGo();
    const cut = this.#cutAt(event);
    this.#held = cut >= 0 ? 'cut' : 'head';
    if (cut >= 0) return editor.grab(cut);
    editor.select(-1);
    clock.seek(Math.floor(this.#frameAt(event)));
  }

  #move(event) {
    this.#pinch.move(event.pointerId, this.#shareAt(event));
    if (this.#pinch.on) return this.#hide();
    if (this.#held === 'head') this.#result.clock.seek(Math.floor(this.#frameAt(event)));
    if (this.#held === 'cut') this.#result.editor.drag(Math.round(this.#frameAt(event)));
    this.#tell(event);
  }

  #release(event) {
    this.#pinch.release(event.pointerId);
    this.#letGo();
  }

  #letGo() {
    if (this.#held === 'cut') this.#result.editor.drop();
    this.#held = null;
  }

  #wheel(event) {
    const { span } = this.#result;
    event.preventDefault();
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      span.pan(((event.deltaX || event.deltaY) / this.#result.curve.plot.width) * span.length);
    } else span.zoom(Math.exp(-event.deltaY * WHEEL), this.#frameAt(event));
  }

  /** Say what is under the pointer, or where the cut is that it drags. */
  #tell(event) {
    const { span, editor, document: { segments } } = this.#result;
    const cut = { head: -1, cut: editor.cut }[this.#held] ?? this.#cutAt(event);
    const frame = cut >= 0 ? segments[cut].end : Math.min(span.frames - 1, Math.floor(this.#frameAt(event)));
    const segment = segments[this.#result.indexAt(frame)];
    const what = cut >= 0 ? 'cut' : segment.name + repetition(segment, frame);
    this.#box.classList.toggle('on-cut', cut >= 0);
    this.#hover.textContent = `${what} · frame ${shownFrame(frame)} · ${clockTime(this.#result.secondsAt(frame))}`;
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

const CLOSE = 0.02; // share of the width below which two fingers say nothing of how far to zoom

export class Pinch {
  #span; #fingers = new Map();

  constructor(span) { this.#span = span; }

  get on() { return this.#fingers.size > 1; }

  /** A finger comes down at a share of the width: from now on each holds the frame it is on. */
  press(id, share) {
    this.#fingers.set(id, { share });
    for (const finger of this.#fingers.values()) finger.frame = this.#span.from + finger.share * this.#span.length;
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
    this.#span.set(from, from + length);
  }

  release(id) { this.#fingers.delete(id); }
}
