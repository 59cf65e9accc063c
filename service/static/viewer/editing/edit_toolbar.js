// The toolbar of editing: the current segment, the selected cut, and whether the edits are saved.

import { frameNumber, onFrameNumbering, frameText, parseFrame } from '../number_format.js';
import { $, make } from '../dom.js';
import { motionColour } from '../palette.js';
import { motionsOf } from './segment_edits.js';

const NEW = 'new';

/** Wire the toolbar once. `editor()` is the current editor. Answers a function that shows its state. */
export function addEditToolbar(editor, { loadTheirs }) {
  const on = (id, event, action) => $(id).addEventListener(event, action);
  const name = $('motion-name');
  name.addEventListener('change', () => { editor().rename(name.value); show(); });
  for (const field of [name, $('cut-frame')]) {
    field.addEventListener('keydown', (event) => {
      if (event.key === 'Escape') { show(true); field.blur(); }
      if (event.key === 'Enter') field.blur();
    });
  }
  on('motion-of', 'change', (event) => editor().assignMotion(event.target.value === NEW ? null : Number(event.target.value)));
  on('flag-loop', 'click', () => editor().toggleFlag('loop'));
  on('flag-discard', 'click', () => editor().toggleFlag('discard'));
  on('split', 'click', () => editor().split());
  on('cut-before', 'click', () => editor().selectNext(-1));
  on('cut-after', 'click', () => editor().selectNext(1));
  on('nudge-back', 'click', () => editor().nudge(-1));
  on('nudge-on', 'click', () => editor().nudge(1));
  on('cut-frame', 'change', (event) => {
    const frame = parseFrame(event.target.value);
    if (frame !== null) editor().moveTo(frame);
    show(true);
  });
  on('merge', 'click', (event) => editor().merge(event.shiftKey));
  on('undo', 'click', () => editor().undo());
  on('redo', 'click', () => editor().redo());

  function show(evenFocused = false) {
    const at = editor();
    if (!at) return;
    showSegment(at, evenFocused);
    showCut(at, evenFocused);
    $('undo').disabled = !at.canUndo;
    $('redo').disabled = !at.canRedo;
    showSavingState(at, loadTheirs);
  }
  onFrameNumbering(() => show());
  return show;
}

function showSegment(editor, evenFocused) {
  const affected = editor.affected.map((index) => editor.segments[index]);
  const [segment] = affected;
  const several = editor.chosen.size > 1;
  $('chosen-count').textContent = several ? `${editor.chosen.size} segments` : '';
  $('split').hidden = several;
  $('one-clip').textContent = several ? 'Save clips' : 'Save clip';
  const name = $('motion-name');
  if (evenFocused || name !== document.activeElement) name.value = segment.name;
  name.style.setProperty('--motion', motionColour(segment.motion));
  const motions = motionsOf(editor.segments);
  const names = motions.map((motion) => motion.name).join('\n');
  const select = $('motion-of');
  if (select.dataset.names !== names) {
    select.dataset.names = names;
    select.replaceChildren(...motions.map((motion) => make('option', { value: motion.motion }, `is ${motion.name}`)),
      make('option', { value: NEW }, 'is a new motion'));
  }
  select.value = segment.motion;
  for (const flag of ['loop', 'discard']) $(`flag-${flag}`).setAttribute('aria-pressed', String(affected.every((one) => one[flag])));
}

function showCut(editor, evenFocused) {
  const { cut, segments } = editor;
  const none = cut < 0;
  $('cut-title').textContent = none ? '' : `${segments[cut].name} | ${segments[cut + 1].name}`;
  for (const id of ['cut-before', 'cut-after']) $(id).disabled = segments.length < 2;
  const field = $('cut-frame');
  if (evenFocused || field !== document.activeElement) field.value = none ? '' : frameNumber(segments[cut].end);
  $('timeline').setAttribute('aria-description', none ? '' : `Cut at frame ${frameText(segments[cut].end)} selected. Arrows move it.`);
}

const WORDS = {
  waiting: () => 'Not saved yet',
  saving: () => 'Saving …',
  saved: (saving) => (saving.shown ? `Saved · revision ${saving.shown}` : 'As computed'),
  failed: (saving) => `Not saved. ${saving.why}${saving.again ? ' The page tries again.' : ''}`,
  stale: (saving) => `Not saved: somebody else saved revision ${saving.theirs} first.`,
};

/** Say whether the edits are saved, and offer what to do if they are not. */
function showSavingState(editor, loadTheirs) {
  const { saving } = editor;
  const words = WORDS[saving.kind](saving);
  $('kept').dataset.kind = saving.kind;
  if ($('kept-word').textContent === words) return; // a screen reader reads a status again when it is set again
  $('kept-word').textContent = words;
  const way = (text, action) => make('button', { type: 'button', onclick: action }, text);
  const ways = {
    failed: () => [way('Try again', () => saving.flush().catch(() => {}))],
    stale: () => [way('Load theirs', loadTheirs), way('Keep mine', () => saving.overwrite().catch(() => {}))],
  };
  $('kept-ways').replaceChildren(...(ways[saving.kind]?.() || []));
}
