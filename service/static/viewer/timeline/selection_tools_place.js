// The tools of what is selected, a segment or a cut: they stand under it, in a row of their own, and one kind at a time.

import { $ } from '../dom.js';

const EDGE = 8; // pixels that stay free beside them

/** Put the tools under `x`, in pixels of the row, as far as the row has room beside its other things. */
export function placeTools(x) {
  const [row, tools, beside] = [$('edit'), $('selection-tools'), $('kept-tools')];
  const width = row.clientWidth;
  const wide = tools.offsetWidth;
  const room = width - beside.offsetWidth - 2 * EDGE;
  const apart = beside.offsetTop >= tools.offsetTop + tools.offsetHeight; // a narrow row: they stand under each other
  const most = Math.max(0, (apart ? width : room) - wide);
  const left = Math.max(0, Math.min(most, x - wide / 2));
  tools.style.transform = `translateX(${left}px)`;
  tools.style.setProperty('--anchor', `${Math.max(14, Math.min(wide - 14, x - left))}px`);
}
