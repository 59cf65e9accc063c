// The poses that the figure panel shows: of the playhead, on both sides of a cut, or of the repeats that are compared.

import { $ } from '../dom.js';
import { cutLabels } from '../panels/status.js';
import { comparedPoses } from '../timeline/comparison.js';

const MOST_GHOSTS = 6;

const poseOf = ({ position, segment: { motion, start } }) => ({ position, motion, start });

export class ShownPoses {
  #result;

  constructor(result) { this.#result = result; }

  /** The segments on both sides of the selected cut, while they are compared; else null. */
  get pair() {
    const { editor: { cut }, playhead, document } = this.#result;
    return cut >= 0 && !playhead.playing ? document.segments.slice(cut, cut + 2) : null;
  }

  /** What stands under poses side by side; null where there is one. */
  get labels() { return this.pair ? cutLabels(this.pair) : this.#compared('beside'); }

  /** `{ position, motion, start }` of each, the current one first where it is alone; `start` is the first frame of a repeat that is compared. */
  get poses() {
    if (this.pair) {
      const [before, after] = this.pair;
      return [{ position: before.end - 1, motion: before.motion }, { position: after.start, motion: after.motion }];
    }
    const compared = this.#compared('beside');
    if (compared) return compared.map(poseOf);
    const current = this.#compared('over')?.find((item) => item.current);
    return [current ? poseOf(current) : { position: this.#position, motion: this.#segment.motion }];
  }

  /** The other repeats laid over, or the key-frames of the current segment, evenly chosen; none where several poses are shown. */
  get ghosts() {
    const overlaid = this.#compared('over');
    if (overlaid) return overlaid.filter(({ current }) => !current).map(poseOf);
    if (this.pair || !$('ghosts').checked || this.#compared('beside')) return [];
    const { start, end, motion } = this.#segment;
    const keys = this.#result.document.key_frames.filter(({ frame }) => frame >= start && frame < end);
    const step = Math.max(1, keys.length / MOST_GHOSTS);
    const chosen = Array.from({ length: Math.min(keys.length, MOST_GHOSTS) }, (_, i) => keys[Math.floor(i * step)]);
    return chosen.map(({ frame }) => ({ position: frame, motion }));
  }

  /** Paused: the frame's own pose. Playing: between two frames too, so that it is smooth on a fast screen. */
  get #position() {
    const { playing, position, frame } = this.#result.playhead;
    return playing ? position : frame;
  }

  get #segment() { return this.#result.document.segments[this.#result.segmentIndexAt(this.#result.playhead.frame)]; }

  /** The repeats of the current motion, if they are compared in the way `way`; else null. */
  #compared(way) {
    if ($('compare').value !== way || this.pair) return null;
    const { document, playhead } = this.#result;
    return comparedPoses(document, this.#result.segmentIndexAt(playhead.frame), this.#position, way, $('stage').clientWidth);
  }
}
