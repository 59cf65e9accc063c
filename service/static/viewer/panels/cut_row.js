// A cut as a row of the review: what it divides, at which frame, and how certain it is or who says so.

import { doubtful } from '../editing/certainty.js';
import { shownFrame } from '../frame_numbering.js';
import { make, unseen } from '../dom.js';
import { swatch } from '../palette.js';

/** What the row of the cut between two segments says, and a key that is another whenever the row must be. */
export function cutText(before, after, checked) {
  const known = checked ? 'checked' : before.confidence === null ? 'set by hand' : null;
  const state = known || `${Math.round(100 * before.confidence)} %`;
  const frame = shownFrame(before.end);
  return { frame, state, known, key: [frame, state, before.motion, before.name, after.motion, after.name].join('\n') };
}

/** The row, a button that calls `choose`. */
export function cutRow(before, after, { frame, state, known }, choose) {
  const names = `${before.name} | ${after.name}`;
  const row = make('button', { type: 'button', className: 'cut', tabIndex: -1, onclick: choose },
    swatch(before.motion), swatch(after.motion),
    make('span', { className: 'name', title: names }, names),
    unseen(' at frame '),
    make('span', { className: 'from' }, frame),
    unseen(known ? ' ' : ' certain to '),
    make('span', { className: 'sure' }, state));
  row.classList.toggle('open', !known && doubtful(before));
  return row;
}
