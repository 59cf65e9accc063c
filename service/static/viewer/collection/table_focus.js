// A table whose buttons the Tab key stops at once: the arrows go from cell to cell, past those without a button.

import { setTabStop } from '../roving_focus.js';

const STEPS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };

/** Wire a table once. */
export function addTableFocus(table) {
  table.addEventListener('keydown', (event) => {
    const cell = event.target.closest('td, th');
    const step = STEPS[event.key];
    if (!cell || !step) return;
    event.preventDefault();
    const button = nextButton(table, cell, step);
    if (!button) return;
    setTabStop(table, 'button', button);
    button.focus();
  });
  table.addEventListener('focusin', ({ target }) => target.localName === 'button' && setTabStop(table, 'button', target));
}

function nextButton(table, cell, [down, right]) {
  let [row, column] = [cell.parentElement.rowIndex, cell.cellIndex];
  for (;;) {
    row += down;
    column += right;
    const next = table.rows[row]?.cells[column];
    const button = next?.querySelector('button');
    if (!next || button) return button;
  }
}
