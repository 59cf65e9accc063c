// A row of a batch: the name of a file, how far it is, and at last its segments or what is wrong with it.

import { make } from '../dom.js';
import { count } from '../number_format.js';
import { segmentStrip } from './segment_strip.js';

/** The element of `row`; `open(row)` is called when a person opens its result. */
export function batchRow(row, open) {
  const note = make('span', { className: 'row-note' });
  const strip = make('span', { className: 'strip-place' });
  const bar = make('progress', { max: 1, 'aria-label': `Progress of ${row.name}` });
  const link = make('button', { type: 'button', onclick: () => open(row) }, 'Open', make('span', { className: 'unseen' }, ` ${row.name}`));
  row.elements = { note, strip, bar, link, item: make('li', {}, make('strong', { title: row.name }, row.name), strip, bar, note, link) };
  showRow(row);
  return row.elements.item;
}

/** Show a row as it is now. */
export function showRow({ problem, done, said, share, elements }) {
  if (!elements) return;
  const { note, strip, bar, link } = elements;
  note.textContent = problem ?? (done ? `${count(done.motions, 'motion')}, ${count(done.segments.length, 'segment')}` : said);
  note.classList.toggle('problem-line', Boolean(problem));
  if (done && !strip.firstChild) strip.append(segmentStrip(done.segments, done.frames));
  bar.hidden = Boolean(problem || done);
  if (share === undefined || share === null) bar.removeAttribute('value'); else bar.value = share;
  link.hidden = !done;
}
