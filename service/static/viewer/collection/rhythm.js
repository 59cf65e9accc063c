// The segments of a motion that are compared, and how far each is into the motion: the first leads, the others keep its rhythm.

import * as api from '../service/api.js';
import { inRhythm } from '../timeline/comparison.js';

/** The segments of a motion in the takes that are loaded, `{ take, segment }`: the exemplar, the most typical of each take, the others. */
export function segmentsOf(collection, { id, exemplar }) {
  const found = [];
  for (const take of collection.labelled) {
    const share = take.motions.find(({ motion }) => motion === id);
    for (const segment of take.segments) {
      if (segment.motion !== id) continue;
      const leads = take.animation === exemplar.animation && segment.start === exemplar.start;
      found.push({ take, segment, rank: leads ? 0 : segment.start === share?.start ? 1 : 2 });
    }
  }
  return found.sort((one, other) => one.rank - other.rank);
}

/** The same segments with `repeats`: the repetitions that the result of the take alone has in them. */
export async function withRepeats(items) {
  const results = new Map(items.map(({ take }) => [take.segmentation, api.result(take.segmentation).catch(() => null)]));
  return Promise.all(items.map(async ({ take, segment }) => {
    const { start, end } = segment;
    const own = (await results.get(take.segmentation))?.segments.find((one) => one.start === start && one.end === end);
    return { take, segment: { ...segment, repeats: own?.repeats ?? [] } };
  }));
}

/** How far into its own frames each segment is, 0 to 1, where the first is at `share`. */
export function sharesOf(segments, share) {
  const [first] = segments;
  const frame = first.start + share * (first.end - first.start);
  return segments.map((segment) => {
    const at = segment === first ? frame : inRhythm(frame, first, segment);
    return Math.min(1 - 1e-6, Math.max(0, (at - segment.start) / (segment.end - segment.start)));
  });
}
