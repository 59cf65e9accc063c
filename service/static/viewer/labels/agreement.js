// How far a segmentation agrees with labels: the share of labelled frames, and the cuts.

const NEAR = 0.5; // seconds that a cut may be off

/**
 * `motions` says which motion a label most nearly is (one to one, the largest overlap first), `share` is the share of labelled
 * frames that agree, `cuts` how many of the `expected` cuts between labels have one of the segmentation near.
 */
export function agreement(labels, { segments, frame_rate: rate }) {
  const overlaps = new Map();
  let labelled = 0;
  let at = 0;
  for (const { start, end, name } of labels) {
    labelled += end - start;
    while (at > 0 && segments[at].start > start) at -= 1;
    while (segments[at].end <= start) at += 1;
    for (let i = at; i < segments.length && segments[i].start < end; i++) {
      const frames = Math.min(end, segments[i].end) - Math.max(start, segments[i].start);
      const key = JSON.stringify([name, segments[i].motion]);
      overlaps.set(key, (overlaps.get(key) ?? 0) + frames);
    }
  }
  const motions = new Map();
  const taken = new Set();
  let same = 0;
  for (const [key, frames] of [...overlaps].sort((one, other) => other[1] - one[1])) {
    const [name, motion] = JSON.parse(key);
    if (motions.has(name) || taken.has(motion)) continue;
    motions.set(name, motion);
    taken.add(motion);
    same += frames;
  }
  const found = segments.slice(0, -1).map(({ end }) => end);
  const expected = labels.slice(1).filter(({ name }, i) => name !== labels[i].name).map(({ start }) => start);
  const cuts = expected.filter((frame) => found.some((cut) => Math.abs(cut - frame) <= NEAR * rate)).length;
  return { motions, share: labelled ? same / labelled : 0, cuts, expected: expected.length };
}
