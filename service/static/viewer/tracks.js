// Pointer and wheel over the curve and the timeline: the playhead that runs through both, and cuts to be dragged.

import { shownFrame } from './counting.js';
import { $, onResize } from './dom.js';
import { clock as clockTime } from './numbers.js';

const WHEEL = 0.0018;
const NEAR = { mouse: 5, pen: 8, touch: 14 }; // pixels from a cut that still take hold of it
const ROOM = 16; // pixels a segment has on average before its cuts can be grabbed: closer together, one would grab the wrong one

/** Wire the tracks of a result. Answers a function that moves the playhead and the handle of the selected cut. */
export function tracks(result, signal) {
  const { span, clock } = result;
  const plot = () => result.curve.plot;
  const [box, head, handle, hover] = ['tracks', 'playhead', 'handle', 'hover'].map($);
  const inset = () => box.getBoundingClientRect();
  const frameAt = (event) => span.from + Math.max(0, Math.min(1, (event.clientX - inset().left - plot().left) / plot().width)) * span.length;
  const put = (element, frame) => {
    const { left, width } = plot();
    const share = (frame - span.from) / span.length;
    element.hidden = share < 0 || share > 1;
    element.style.transform = `translateX(${left + share * width}px)`;
  };
  const place = () => {
    put(head, clock.frame + 0.5);
    const { cut, segments } = result.editor;
    if (cut >= 0) put(handle, segments[cut].end); else handle.hidden = true;
    box.classList.toggle('has-cut', cut >= 0);
  };
  /** The cut under the pointer, or -1. */
  const cutAt = (event) => {
    const perFrame = plot().width / span.length;
    const { segments } = result.document;
    const frame = frameAt(event);
    const index = result.indexAt(Math.min(span.frames - 1, Math.floor(frame)));
    const visible = result.indexAt(span.to) - result.indexAt(span.from) + 1;
    if (visible * ROOM > plot().width) return -1;
    const near = [index - 1, index].filter((cut) => cut >= 0 && cut < segments.length - 1)
      .map((cut) => [Math.abs(segments[cut].end - frame) * perFrame, cut]).sort((one, other) => one[0] - other[0])[0];
    return near && near[0] <= (NEAR[event.pointerType] || NEAR.mouse) ? near[1] : -1;
  };
  const tell = (event) => {
    const frame = Math.min(span.frames - 1, Math.floor(frameAt(event)));
    const cut = held ? result.editor.cut : cutAt(event);
    box.classList.toggle('on-cut', cut >= 0 && held !== 'head');
    const segment = result.document.segments[cut >= 0 ? cut : result.indexAt(frame)];
    const at = cut >= 0 && held !== 'head' ? segment.end : frame;
    const what = at === frame && cut < 0 ? segment.name + repetition(segment, frame) : 'cut';
    hover.textContent = `${what} · frame ${shownFrame(at)} · ${clockTime(result.secondsAt(at))}`;
    hover.hidden = false;
    const { left, width } = inset();
    hover.style.transform = `translateX(${Math.max(0, Math.min(width - hover.offsetWidth, event.clientX - left + 12))}px)`;
  };
  let held = null; // 'head' or 'cut' while a pointer is down
  const on = (name, action, options = {}) => box.addEventListener(name, action, { signal, ...options });
  on('pointerdown', (event) => {
    if (event.button) return;
    box.setPointerCapture(event.pointerId);
    const cut = cutAt(event);
    held = cut >= 0 ? 'cut' : 'head';
    if (cut >= 0) return result.editor.grab(cut);
    result.editor.select(-1);
    clock.seek(Math.floor(frameAt(event)));
  });
  on('pointermove', (event) => {
    if (held === 'head') clock.seek(Math.floor(frameAt(event)));
    if (held === 'cut') result.editor.drag(Math.round(frameAt(event)));
    tell(event);
  });
  for (const name of ['pointerup', 'pointercancel']) {
    on(name, () => { if (held === 'cut') result.editor.drop(); held = null; });
  }
  on('pointerleave', () => { hover.hidden = true; box.classList.remove('on-cut'); });
  on('dblclick', (event) => { if (cutAt(event) < 0) span.all(); });
  on('wheel', (event) => {
    event.preventDefault();
    if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      span.pan(((event.deltaX || event.deltaY) / plot().width) * span.length);
    } else span.zoom(Math.exp(-event.deltaY * WHEEL), frameAt(event));
  }, { passive: false });
  span.listen(place);
  onResize(box, place, signal);
  return place;
}

/** Which repetition of its motion a frame is in, in words, where there are several. */
function repetition({ repeats }, frame) {
  const at = repeats.findLastIndex(({ start }) => start <= frame);
  return repeats.length > 1 && at >= 0 ? `, ${at + 1} of ${repeats.length}` : '';
}
