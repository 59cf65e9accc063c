// Edits of a list of segments, as pure functions: each answers a new list, or the same one if nothing changes.
//
// The segments tile the take: segment i+1 starts where segment i ends. Cut i is the end of segment i; the last segment has no
// cut. The confidence of a segment is that of its cut; it is null once a person has placed the cut. The repetitions of a segment
// tile it, so they are fitted to an end that moves.

const LETTERS = 26;

/** The same segments with motions numbered in order of first appearance, as the service numbers them. */
function renumbered(segments) {
  const numbers = new Map();
  for (const { motion } of segments) if (!numbers.has(motion)) numbers.set(motion, numbers.size);
  return segments.map((segment) => ({ ...segment, motion: numbers.get(segment.motion) }));
}

/** Move cut `index` to `frame`; both segments keep at least `least` frames, or what they have. */
export function moveCut(segments, index, frame, least = 1) {
  const before = segments[index];
  const after = segments[index + 1];
  if (!after) return segments;
  const lowest = Math.min(before.end, before.start + least);
  const highest = Math.max(before.end, after.end - least);
  const place = Math.max(lowest, Math.min(highest, Math.round(frame)));
  if (place === before.end) return segments;
  return splice(segments, index, 2,
    fitted({ ...before, end: place, confidence: null }), fitted({ ...after, start: place }));
}

/** Remove cut `index`. The merged segment has the motion before the cut, or the one after it. */
export function mergeCut(segments, index, after = false) {
  const [left, right] = [segments[index], segments[index + 1]];
  if (!right) return segments;
  const kept = after ? right : left;
  const whole = { ...kept, start: left.start, end: right.end, confidence: right.confidence, repeats: [] };
  return renumbered(splice(segments, index, 2, whole));
}

/** Cut at `frame`, which begins the second half. Both halves stay the motion they were. */
export function split(segments, frame) {
  const index = segmentIndexAt(segments, frame);
  const whole = segments[index];
  if (frame <= whole.start || frame >= whole.end) return segments;
  return splice(segments, index, 1,
    fitted({ ...whole, end: frame, confidence: null }), fitted({ ...whole, start: frame }));
}

/** The same segment with its repetitions fitted to its frames: those that begin in it stay. */
function fitted(segment) {
  const { start, end, repeats } = segment;
  if (!repeats.length) return segment;
  const bounds = [start, ...repeats.slice(1).map((repeat) => repeat.start).filter((frame) => start < frame && frame < end), end];
  return { ...segment, repeats: bounds.slice(1).map((to, i) => ({ start: bounds[i], end: to })) };
}

/** The same segments with the repetitions and the best loops that the service has for those it has `saved`. */
export function withRepeats(segments, saved) {
  const found = new Map(saved.map((segment) => [`${segment.start} ${segment.end}`, segment]));
  const told = ({ repeats, best_loop: loop }) => JSON.stringify([repeats.map(({ start }) => start), loop?.start, loop?.end]);
  return segments.map((segment) => {
    const kept = found.get(`${segment.start} ${segment.end}`);
    return !kept || told(kept) === told(segment) ? segment : { ...segment, repeats: kept.repeats, best_loop: kept.best_loop };
  });
}

/** Call a motion `name` everywhere. The name of another motion joins the two. */
export function renameMotion(segments, motion, name) {
  const called = name.trim();
  const current = segments.find((segment) => segment.motion === motion);
  if (!called || !current || current.name === called) return segments;
  const other = segments.find((segment) => segment.name === called);
  const becomes = other ? other.motion : motion;
  return renumbered(segments.map((segment) => (segment.motion === motion ? { ...segment, motion: becomes, name: called } : segment)));
}

/** Make segments, by their indices, another motion; null makes them one of their own. */
export function assignMotion(segments, indices, motion) {
  const known = segments.find((segment) => segment.motion === motion);
  return becomeMotion(segments, indices, known, known ? known.name : freeName(segments));
}

/** Make segments the motion of a name, which there may be already. */
export function nameSegments(segments, indices, name) {
  if (!name) return segments;
  return becomeMotion(segments, indices, segments.find((segment) => segment.name === name), name);
}

function becomeMotion(segments, indices, known, name) {
  const motion = known ? known.motion : 1 + Math.max(...segments.map((segment) => segment.motion));
  return changed(segments, indices, (segment) => segment.motion !== motion, { motion, name }, renumbered);
}

/** Set `loop` or `discard` of segments. */
export const setFlag = (segments, indices, flag, on) => changed(segments, indices, (segment) => Boolean(segment[flag]) !== on, { [flag]: on });

/** The segments with `values` in those of `indices` that `differ`; the same list where none does. */
function changed(segments, indices, differ, values, finish = (list) => list) {
  const wanted = new Set(indices);
  const is = (segment, index) => wanted.has(index) && differ(segment);
  if (!segments.some(is)) return segments;
  return finish(segments.map((segment, index) => (is(segment, index) ? { ...segment, ...values } : segment)));
}

/** The result with other segments: each key-frame belongs to the motion that it is in now. */
export function withSegments(document, segments) {
  let place = 0;
  const keys = document.key_frames.map((key) => {
    while (segments[place].end <= key.frame) place += 1;
    return key.motion === segments[place].motion ? key : { ...key, motion: segments[place].motion };
  });
  return { ...document, segments, key_frames: keys, motions: motionsOf(segments).length };
}

/** The segment that a frame is in, by its place in the list. */
export function segmentIndexAt(segments, frame) {
  let low = 0;
  let high = segments.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (frame < segments[middle].end) high = middle; else low = middle + 1;
  }
  return low;
}

/** The frame that stands for a segment: the middle of its middle repetition, for repetitions begin and end where nothing is seen. */
export function portraitFrame(segment) {
  const { start, end } = segment.repeats[segment.repeats.length >> 1] ?? segment;
  return Math.floor((start + end) / 2);
}

/** Seconds from the first pose of a segment to the first of the next; the last segment ends with the last pose of the take. */
export const segmentSeconds = ({ frames, frame_rate: rate }, { start, end }) => (Math.min(end, frames - 1) - start) / rate;

/** The motions there are, each once, in order. */
export function motionsOf(segments) {
  const seen = new Map();
  for (const { motion, name } of segments) if (!seen.has(motion)) seen.set(motion, { motion, name });
  return [...seen.values()];
}

/** Whether two lists are the same in all that a revision stores. */
export const sameSegments = (one, other) => one === other || (one.length === other.length && one.every((segment, i) =>
  segment.end === other[i].end && segment.name === other[i].name && segment.motion === other[i].motion
  && Boolean(segment.loop) === Boolean(other[i].loop) && Boolean(segment.discard) === Boolean(other[i].discard)));

/** The first of A, B, …, Z, AA, … that is not the name of a motion. */
function freeName(segments) {
  const taken = new Set(segments.map((segment) => segment.name));
  for (let number = 0; ; number++) {
    let name = '';
    for (let left = number; left >= 0; left = Math.floor(left / LETTERS) - 1) name = String.fromCharCode(65 + (left % LETTERS)) + name;
    if (!taken.has(name)) return name;
  }
}

const splice = (segments, index, count, ...others) => [...segments.slice(0, index), ...others, ...segments.slice(index + count)];

const DOUBT = 0.5;

/** Whether the cut that ends a segment is more likely wrong than right. The end of the last segment is certain. */
export const isDoubtful = ({ confidence }) => confidence !== null && confidence < DOUBT;
