// Two poses side by side, the last of one clip and the first of the next: what a cut is judged by.

import { shownFrame } from './counting.js';
import { $ } from './dom.js';
import { tagged } from './palette.js';

/** Say what the two halves of the stage show; without segments, one pose fills it. */
export function captions(before, after) {
  const box = $('pair');
  box.hidden = !before;
  if (!before) return;
  const [left, right] = box.children;
  tagged(left.children[0], before);
  tagged(right.children[0], after);
  left.children[1].textContent = `ends with ${shownFrame(before.end - 1)}`;
  right.children[1].textContent = `begins with ${shownFrame(after.start)}`;
}

