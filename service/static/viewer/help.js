// Every key the page knows, on `?`.

import { $, make } from './dom.js';

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
export function help() {
  const dialog = $('help');
  $('help-keys').replaceChildren(...KEYS.map(([title, keys]) => make('section', {}, make('h3', {}, title),
    make('dl', {}, ...keys.flatMap(([key, what]) => [
      make('dt', {}, ...key.split(' ').map((one) => make('kbd', {}, one))), make('dd', {}, what)])))));
  const open = () => dialog.open || dialog.showModal();
  $('ask-help').addEventListener('click', open);
  dialog.addEventListener('click', (event) => { if (event.target === dialog) dialog.close(); });
  return open;
}
