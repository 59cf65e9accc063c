// The list of segments: what, from where, how long. Every row is a button that goes there.

import { $, make } from './dom.js';
import { duration, whole } from './numbers.js';
import { swatch } from './palette.js';

/** Fill the list. `go(index)` is called when a row is chosen. Answers a function that marks the row that plays. */
export function listed(document, go) {
  const list = $('segments');
  const rows = document.segments.map((segment, index) => {
    const length = (segment.end - segment.start) / document.frame_rate;
    const doubt = index + 1 < document.segments.length && segment.confidence < 0.5;
    const row = make('button', { type: 'button', className: 'segment', onclick: () => go(index) },
      swatch(segment.motion),
      make('span', { className: 'name' }, segment.name),
      make('span', { className: 'from' }, whole(segment.start)),
      make('span', { className: 'long' }, duration(length)),
      doubt ? make('span', { className: 'doubt', title: 'The method is in doubt about where this ends' }, '?') : null);
    row.setAttribute('aria-label',
      `Motion ${segment.name}, from frame ${segment.start}, ${duration(length)}${doubt ? ', doubtful end' : ''}`);
    return row;
  });
  list.replaceChildren(...rows.map((row) => make('li', {}, row)));
  let current = null;
  return (index) => {
    if (rows[index] === current) return;
    current?.removeAttribute('aria-current');
    current = rows[index];
    current?.setAttribute('aria-current', 'true');
    const { scrollTop, clientHeight } = list;
    const top = current ? current.offsetTop : scrollTop; // the list is the rows' offset parent
    if (top < scrollTop || top + 36 > scrollTop + clientHeight) list.scrollTop = top - clientHeight / 2;
  };
}
