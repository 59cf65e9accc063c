// Two poses side by side, the last of one clip and the first of the next: what a cut is judged by.

import { shownFrame } from '../frame_numbering.js';
import { $ } from '../dom.js';
import { tagged } from '../palette.js';

/** Say what the two halves of the stage show, of the segments before and after a cut; without them, one pose fills it. */
export function captions(pair) {
  const box = $('pair');
  box.hidden = !pair;
  if (!pair) return;
  const [before, after] = pair;
  const [left, right] = box.children;
  tagged(left.children[0], before);
  tagged(right.children[0], after);
  left.children[1].textContent = `ends with ${shownFrame(before.end - 1)}`;
  right.children[1].textContent = `begins with ${shownFrame(after.start)}`;
}
