// The rows of the review: a cut, or a frame at which a cut may be missing.

import { isDoubtful } from '../editing/segment_edits.js';
import { make, screenReaderText } from '../dom.js';
import { frameText } from '../number_format.js';
import { motionSwatch } from '../palette.js';

/** The texts of the row of an item, and a key that changes whenever the row must. */
export function reviewText({ frame, segment, after, likelihood, checked }) {
  const share = likelihood ?? segment.confidence;
  const known = checked ? 'checked' : share === null ? 'set by hand' : null;
  const state = known || `${Math.round(100 * share)} %`;
  const names = after ? `${segment.name} | ${after.name}` : `cut missing in ${segment.name}?`;
  const place = frameText(frame);
  return { names, place, state, known, key: [place, state, names, segment.motion, after?.motion].join('\n') };
}

/** The row of an item, a button that calls `choose`. */
export function reviewRow({ segment, after, likelihood }, { names, place, state, known }, choose) {
  const row = make('button', { type: 'button', className: 'cut', tabIndex: -1, onclick: choose },
    motionSwatch(segment.motion), motionSwatch((after ?? segment).motion),
    make('span', { className: 'name', title: names }, names),
    screenReaderText(' at frame '),
    make('span', { className: 'from' }, place),
    screenReaderText(known ? ' ' : after ? ' certain to ' : ' likely to '),
    make('span', { className: 'sure' }, state));
  row.classList.toggle('open', !known && (after ? isDoubtful(segment) : isLikely({ likelihood })));
  return row;
}

/** Whether a cut is more likely missing than not. */
export const isLikely = ({ likelihood }) => likelihood >= 0.5;
