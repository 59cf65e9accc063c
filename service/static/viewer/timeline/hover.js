// What the pointer is over: a cut, a key-frame, or a frame of a segment, in words and as a picture of the pose.

import { $ } from '../dom.js';
import { portraitFrame } from '../editing/segment_edits.js';
import { clockTime, frameText } from '../number_format.js';

export class TimelineHover {
  #box = $('hover'); #result; #pictured = -1;

  constructor(result) { this.#result = result; }

  /** Say what is at `x`, in pixels of the tracks: a cut by its frame, a key-frame, or else a frame. */
  show(x, { frame, cut, key }) {
    const { document, secondsAt } = this.#result;
    const segment = document.segments[this.#result.segmentIndexAt(frame)];
    const what = cut ? 'cut' : key ? `key-frame of ${segment.name}` : segment.name + repetition(segment, frame);
    $('hover-text').textContent = `${what} · frame ${frameText(frame)} · ${clockTime(secondsAt.call(this.#result, frame))}`;
    this.#pictured = cut ? -1 : key ? frame : portraitFrame(segment);
    this.#showPicture();
    this.#box.hidden = false;
    const room = this.#box.parentElement.clientWidth - this.#box.offsetWidth;
    this.#box.style.transform = `translateX(${Math.max(0, Math.min(room, x + 12))}px)`;
  }

  hide() {
    this.#box.hidden = true;
    this.#pictured = -1;
  }

  #showPicture = () => {
    const picture = this.#pictured < 0 ? null : this.#result.thumbnails.of(this.#pictured, this.#showPicture);
    $('hover-picture').replaceChildren(...(picture ? [picture] : []));
  };
}

/** Which repetition of its motion a frame is in, in words, where there are several. */
function repetition({ repeats }, frame) {
  const at = repeats.findLastIndex(({ start }) => start <= frame);
  return repeats.length > 1 && at >= 0 ? `, ${at + 1} of ${repeats.length}` : '';
}
