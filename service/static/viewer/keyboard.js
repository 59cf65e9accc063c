// The keys of the page, and the list of them on `?`. A key that types into a field belongs to the field.

import { $, make } from './dom.js';
import { compareNext } from './timeline/comparison.js';
import { goToKeyFrame } from './timeline/key_frames.js';
import { goToNeighbour, zoomToSegment } from './timeline/navigation.js';

/** Every key, by groups: how the list shows it, what it does in words, and the actions by the names of keys. */
function keyTable(shown) {
  const step = (frames) => {
    const { playhead, range, editor } = shown();
    if (editor.cut >= 0) return editor.nudge(frames);
    playhead.toggle(false);
    playhead.seek(playhead.frame + frames);
    range.reveal(playhead.frame);
  };
  const goTo = (frame) => { shown().playhead.seek(frame); shown().range.reveal(frame); };
  const zoom = (factor) => shown().range.zoom(factor, shown().playhead.frame);
  const merge = (event) => shown().editor.merge(event.shiftKey);
  const click = (id) => () => $(id).click();
  const side = (name) => () => shown().figurePanel.scene?.lookFrom(name);
  return [
    ['Play', [
      ['Space', 'play or pause', { ' ': () => shown().playhead.toggle() }],
      ['← →', 'go one frame back or on; with Shift ten', {
        ArrowLeft: (event) => step(event.shiftKey ? -10 : -1), ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
      }],
      ['Home End', 'go to the first or last frame', { Home: () => goTo(0), End: () => goTo(shown().playhead.frames - 1) }],
      [', .', 'go to the segment before or after', { ',': () => goToNeighbour(shown(), -1), '.': () => goToNeighbour(shown(), 1) }],
      ['J K', 'go to the key-frame before or after', { j: () => goToKeyFrame(shown(), -1), k: () => goToKeyFrame(shown(), 1) }],
      ['L', 'repeat the segment', { l: click('loop') }],
    ]],
    ['Cuts', [
      ['[ ]', 'select the cut before or after', { '[': () => shown().editor.selectNext(-1), ']': () => shown().editor.selectNext(1) }],
      ['← →', 'move the selected cut one frame; with Shift ten', {}],
      ['Ctrl drag', 'snap the cut to key-frames and low points of the curve', {}],
      ['M Del', 'remove the cut; with Shift, keep the motion after it', { m: merge, Delete: merge, Backspace: merge }],
      ['Esc', 'select no cut, and no segments', { Escape: () => { shown().editor.select(-1); shown().editor.chooseOnly([]); } }],
      ['S', 'split the segment at the playhead', { s: () => shown().editor.split() }],
    ]],
    ['Segments', [
      ['Shift ↑ ↓', 'in the list, choose several segments', {}],
      ['R', 'rename the motion', { r: () => { $('motion-name').focus(); $('motion-name').select(); } }],
      ['O', 'mark the clip as a loop', { o: () => shown().editor.toggleFlag('loop') }],
      ['X', 'discard the segment', { x: () => shown().editor.toggleFlag('discard') }],
      ['Ctrl Z', 'undo', {}], ['Ctrl Shift Z', 'redo', {}],
    ]],
    ['Review', [
      ['N', 'go to the next doubtful or missing cut', { n: click('doubtful') }],
      ['P', 'play one second around the cut', { p: click('around') }],
      ['C', 'mark the cut as checked and go on', { c: click('checked') }],
    ]],
    ['View', [
      ['+ −', 'zoom in or out', { '+': () => zoom(1.6), '=': () => zoom(1.6), '-': () => zoom(1 / 1.6) }],
      ['0', 'show the whole take', { 0: () => shown().range.showAll() }],
      ['Z', 'show the segment alone', { z: () => zoomToSegment(shown()) }],
      ['F', 'show the whole figure', { f: click('reframe') }],
      ['1 2 3', 'look from the front, from the side, from above', { 1: side('front'), 2: side('side'), 3: side('top') }],
      ['V', 'compare the repeats of the motion: side by side, overlaid, not', { v: compareNext }],
      ['G', 'show the poses of the key-frames too', { g: click('ghosts') }],
      ['?', 'show these keys', {}],
    ]],
  ];
}

/** Wire all keys once. `shown()` is the result on screen, or null. */
export function addKeyboard(shown) {
  const table = keyTable(shown);
  const actions = Object.assign({}, ...table.flatMap(([, keys]) => keys.map(([, , byName]) => byName)));
  const showHelp = addHelp(table);
  addEventListener('keydown', (event) => {
    if (event.altKey || document.querySelector('dialog[open]') || belongsToControl(event)) return;
    if (event.ctrlKey || event.metaKey) return undoOrRedo(event, shown);
    if (event.key === '?') return showHelp();
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!shown() || !action) return;
    event.preventDefault();
    action(event);
  });
  addEventListener('keyup', (event) => { // some browsers press a button then
    if (event.key === ' ' && shown() && !belongsToControl(event)) event.preventDefault();
  });
}

/** Fill the list of keys; answers a function that opens it. */
function addHelp(table) {
  const dialog = $('help');
  $('help-keys').replaceChildren(...table.map(([title, keys]) => make('section', {}, make('h3', {}, title),
    make('dl', {}, ...keys.flatMap(([key, words]) => [
      make('dt', {}, ...key.split(' ').map((part) => make('kbd', {}, part))), make('dd', {}, words)])))));
  const open = () => dialog.open || dialog.showModal();
  $('ask-help').addEventListener('click', open);
  dialog.addEventListener('click', (event) => { if (event.target === dialog) dialog.close(); });
  return open;
}

/** Whether a key is for the control that has the focus: it types, chooses or presses there. */
function belongsToControl({ key, target }) {
  if (target.matches('input:not([type=radio]):not([type=checkbox]), textarea')) return true;
  if (key === ' ' && target === clicked) return false; // after a click on a button, Space plays
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

let byPointer = false;
let clicked = null; // what has the focus because the pointer gave it, not the Tab key
addEventListener('pointerdown', () => { byPointer = true; }, true);
addEventListener('keydown', () => { byPointer = false; }, true);
addEventListener('focusin', ({ target }) => { clicked = byPointer ? target : null; });
