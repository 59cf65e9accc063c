// The rows of the list of segments: a segment, and the motion that several segments are of.

import { isDoubtful, segmentSeconds } from '../editing/segment_edits.js';
import { firstFrameNumber, duration, frameText, intervalText } from '../number_format.js';
import { make, screenReaderText } from '../dom.js';
import { motionSwatch } from '../palette.js';

/**
 * The row of a segment of `document`: a button with its `picture` that calls `go(event)`, and a box to choose it that
 * calls `choose(event)`.
 */
export function segmentRow(document, segment, { picture, go, choose }) {
  const counted = Boolean(firstFrameNumber());
  const place = counted ? intervalText(segment.start, segment.end) : frameText(segment.start);
  const button = make('button', { type: 'button', className: 'segment', tabIndex: -1, onclick: go },
    motionSwatch(segment.motion),
    make('span', { className: 'picture' }, picture),
    make('span', { className: 'name', title: segment.name }, segment.name),
    screenReaderText(counted ? ' frames ' : ' from frame '),
    make('span', { className: 'from' }, place),
    screenReaderText(' lasts '),
    make('span', { className: 'long' }, duration(segmentSeconds(document, segment))),
    make('span', { className: 'marks' }, segment.loop ? make('span', {}, '↻', screenReaderText(' loops')) : null,
      isDoubtful(segment) ? make('b', { title: 'The method doubts where this segment ends' }, '?', screenReaderText(' doubtful end')) : null));
  if (segment.discard) button.append(screenReaderText(' discarded'));
  button.classList.toggle('discarded', Boolean(segment.discard));
  const box = make('input', { type: 'checkbox', className: 'pick', tabIndex: -1, onclick: choose, 'aria-label': `Choose ${segment.name} from frame ${frameText(segment.start)}` });
  return { item: make('li', { className: 'segment-item' }, box, button), button, box };
}

/** How long segments are together, in words. */
export const motionLength = (document, segments) => duration(segments.reduce((sum, segment) => sum + segmentSeconds(document, segment), 0));

/**
 * The row of a motion: its picture, its name, how often and how long it is. `choose(event)` chooses all of its segments; `fold()`
 * hides or shows them.
 */
export function motionRow(document, segments, { open, choose, fold, picture }) {
  const [{ motion, name }] = segments;
  const arrow = make('button', { type: 'button', className: 'fold', tabIndex: -1, onclick: fold, 'aria-expanded': String(open), 'aria-label': `Segments of ${name}` }, '▸');
  const button = make('button', { type: 'button', className: 'motion', tabIndex: -1, onclick: choose, title: 'Choose all segments of this motion' },
    make('span', { className: 'picture' }, picture),
    motionSwatch(motion),
    make('span', { className: 'name', title: name }, name),
    make('span', { className: 'times' }, `×\u202f${segments.length}`),
    make('span', { className: 'long' }, motionLength(document, segments)));
  return make('li', { className: 'motion-item' }, arrow, button);
}
