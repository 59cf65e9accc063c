// The page by keyboard alone, and the list of its keys. A key that types into a field is the field's.

import { $, make } from './dom.js';
import { goToNeighbour } from './timeline/navigation.js';

/** `shown()` is the result on screen, or null; `showHelp` opens the list of keys. */
export function addKeyboard(shown, showHelp) {
  const step = (frames) => {
    const { playhead, range, editor } = shown();
    if (editor.cut >= 0) return editor.nudge(frames);
    playhead.toggle(false);
    playhead.seek(playhead.frame + frames);
    range.reveal(playhead.frame);
  };
  const to = (frame) => { shown().playhead.seek(frame); shown().range.reveal(frame); };
  const zoom = (factor) => shown().range.zoom(factor, shown().playhead.frame);
  const click = (id) => () => $(id).click();
  const keys = {
    ' ': () => shown().playhead.toggle(),
    ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
    Home: () => to(0),
    End: () => to(shown().playhead.frames - 1),
    ',': () => goToNeighbour(shown(), -1),
    '.': () => goToNeighbour(shown(), 1),
    '+': () => zoom(1.6),
    '=': () => zoom(1.6),
    '-': () => zoom(1 / 1.6),
    0: () => shown().range.showAll(),
    '[': () => shown().editor.selectNext(-1),
    ']': () => shown().editor.selectNext(1),
    Escape: () => shown().editor.select(-1),
    m: (event) => shown().editor.merge(event.shiftKey),
    Delete: (event) => shown().editor.merge(event.shiftKey),
    Backspace: (event) => shown().editor.merge(event.shiftKey),
    s: () => shown().editor.split(),
    r: () => { $('motion-name').focus(); $('motion-name').select(); },
    o: () => shown().editor.toggleFlag('loop'),
    x: () => shown().editor.toggleFlag('discard'),
    n: click('doubtful'),
    p: click('around'),
    c: click('checked'),
    l: click('loop'),
    f: click('reframe'),
  };
  addEventListener('keydown', (event) => {
    if (event.altKey || document.querySelector('dialog[open]') || belongsToControl(event)) return;
    if (event.ctrlKey || event.metaKey) return undoOrRedo(event, shown);
    if (event.key === '?') return showHelp();
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!shown() || !action) return;
    event.preventDefault();
    action(event);
  });
  addEventListener('keyup', (event) => { // when some browsers press a button
    if (event.key === ' ' && shown() && !belongsToControl(event)) event.preventDefault();
  });
}

/** Whether a key is for the control that has the focus: it types, chooses or presses there. */
function belongsToControl({ key, target }) {
  if (target.matches('input:not([type=radio]):not([type=checkbox]), textarea')) return true;
  if (key === ' ' && hasPointerFocus(target)) return false;
  if (target.matches('select')) return true;
  if (key.startsWith('Arrow')) return target.matches('input[type=radio]');
  return [' ', 'Enter'].includes(key) && target.matches('button, a, label, summary, input');
}

/** Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y. */
function undoOrRedo(event, shown) {
  const key = event.key.toLowerCase();
  if (!shown() || !['z', 'y'].includes(key)) return;
  event.preventDefault();
  if (key === 'y' || event.shiftKey) shown().editor.redo(); else shown().editor.undo();
}

const KEYS = [
  ['Play', [
    ['Space', 'play or pause'], ['← →', 'a frame back or on; with Shift ten'], ['Home End', 'to the first or last frame'],
    [', .', 'the segment before or after'], ['L', 'repeat the segment'],
  ]],
  ['Cuts', [
    ['[ ]', 'select the cut before or after'], ['← →', 'move the selected cut a frame; with Shift ten'],
    ['M Del', 'merge over it; with Shift, as the motion after it'], ['Esc', 'let go of it'], ['S', 'split at the playhead'],
  ]],
  ['Segments', [['R', 'rename the motion'], ['O', 'its clip loops'], ['X', 'discard it'], ['Ctrl Z', 'undo'], ['Ctrl Shift Z', 'redo']]],
  ['Review', [['N', 'the next doubtful cut'], ['P', 'play a second around it'], ['C', 'checked, and on']]],
  ['View', [['+ −', 'zoom in or out'], ['0', 'the whole take'], ['F', 'the whole figure'], ['?', 'these keys']]],
];

/** Wire the overlay once; answers a function that opens it. */
export function addHelp() {
  const dialog = $('help');
  $('help-keys').replaceChildren(...KEYS.map(([title, keys]) => make('section', {}, make('h3', {}, title),
    make('dl', {}, ...keys.flatMap(([key, what]) => [
      make('dt', {}, ...key.split(' ').map((one) => make('kbd', {}, one))), make('dd', {}, what)])))));
  const open = () => dialog.open || dialog.showModal();
  $('ask-help').addEventListener('click', open);
  dialog.addEventListener('click', (event) => { if (event.target === dialog) dialog.close(); });
  return open;
}

let byPointer = false;
let focused = null;

addEventListener('pointerdown', () => { byPointer = true; }, true);
addEventListener('keydown', () => { byPointer = false; }, true);
addEventListener('focusin', ({ target }) => { focused = byPointer ? target : null; });

/** Whether a pointer gave the focus to an element. */
export const hasPointerFocus = (element) => element === focused;
