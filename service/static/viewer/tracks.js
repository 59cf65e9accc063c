// Pointer and wheel over the curve and the timeline, and the playhead that runs through both.

import { $, onResize } from './dom.js';
import { clock as clockTime, whole } from './numbers.js';

const WHEEL = 0.0018;

/** Wire the tracks. `segmentAt(frame)` names what lies under the pointer. Answers a function that moves the playhead. */
export function tracks({ span, clock, plot, segmentAt, seconds, signal }) {
  const box = $('tracks');
  const head = $('playhead');
  const hover = $('hover');
  const frameAt = (event) => {
    const { left } = box.getBoundingClientRect();
    const { left: inset, width } = plot();
    return span.from + Math.max(0, Math.min(1, (event.clientX - left - inset) / width)) * span.length;
  };
  const place = () => {
    const { left, width } = plot();
    const share = (clock.frame + 0.5 - span.from) / span.length;
    head.hidden = share < 0 || share > 1;
    head.style.transform = `translateX(${left + share * width}px)`;
  };
  const tell = (event) => {
    const frame = Math.min(span.frames - 1, Math.floor(frameAt(event)));
    const segment = segmentAt(frame);
    hover.textContent = `${segment ? segment.name : ''} · frame ${whole(frame)} · ${clockTime(seconds(frame))}`;
    const { left, width } = box.getBoundingClientRect();
    hover.hidden = false;
    hover.style.transform = `translateX(${Math.max(0, Math.min(width - hover.offsetWidth, event.clientX - left + 12))}px)`;
  };
  let held = false;
  const on = (name, action, options = {}) => box.addEventListener(name, action, { signal, ...options });
  on('pointerdown', (event) => {
    if (event.button) return;
    held = true;
    box.setPointerCapture(event.pointerId);
    clock.seek(Math.floor(frameAt(event)));
  });
  on('pointermove', (event) => {
    tell(event);
    if (held) clock.seek(Math.floor(frameAt(event)));
  });
  for (const name of ['pointerup', 'pointercancel']) on(name, () => { held = false; });
  on('pointerleave', () => { hover.hidden = true; });
  on('dblclick', () => span.all());
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
