// Going to segments of a result, and staying in one.

import { $ } from '../dom.js';

/** To the first frame of a segment. */
export function goTo({ document, editor, clock, span }, index) {
  const { start, end } = document.segments[index];
  editor.select(-1);
  clock.seek(start);
  if ($('loop').checked) clock.loop = [start, end];
  span.reveal(start);
}

/** To the segment before or after. Going back from within one goes to its own start first. */
export function jump(result, by) {
  const { document: { segments }, clock } = result;
  const index = result.indexAt(clock.frame);
  const started = clock.frame - segments[index].start > clock.rate / 2;
  goTo(result, by < 0 && started ? index : Math.max(0, Math.min(segments.length - 1, index + by)));
}

/** Play the segment of the moment again and again, or go on from it. */
export function loop(result, on) {
  const { start, end } = result.document.segments[result.indexAt(result.clock.frame)];
  result.clock.loop = on ? [start, end] : null;
}
