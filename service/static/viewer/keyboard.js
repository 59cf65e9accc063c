// The page by keyboard alone. A key that types into a field is the field's.

import { $ } from './dom.js';
import { jump } from './visits.js';

/** `shown()` is the result on screen, or null; `askHelp` opens the list of keys. */
export function keyboard(shown, askHelp) {
  const step = (frames) => {
    const { clock, span, editor } = shown();
    if (editor.cut >= 0) return editor.nudge(frames);
    clock.toggle(false);
    clock.seek(clock.frame + frames);
    span.reveal(clock.frame);
  };
  const to = (frame) => { shown().clock.seek(frame); shown().span.reveal(frame); };
  const zoom = (factor) => shown().span.zoom(factor, shown().clock.frame);
  const click = (id) => () => $(id).click();
  const keys = {
    ' ': () => shown().clock.toggle(),
    ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
    Home: () => to(0),
    End: () => to(shown().clock.frames - 1),
    ',': () => jump(shown(), -1),
    '.': () => jump(shown(), 1),
    '+': () => zoom(1.6),
    '=': () => zoom(1.6),
    '-': () => zoom(1 / 1.6),
    0: () => shown().span.all(),
    '[': () => shown().editor.selectNext(-1),
    ']': () => shown().editor.selectNext(1),
    Escape: () => shown().editor.select(-1),
    m: (event) => shown().editor.merge(event.shiftKey),
    s: () => shown().editor.split(),
    r: () => { $('motion-name').focus(); $('motion-name').select(); },
    o: () => shown().editor.flag('loop'),
    x: () => shown().editor.flag('discard'),
    n: click('doubtful'),
    p: click('around'),
    c: click('checked'),
    l: click('loop'),
    f: click('reframe'),
  };
  addEventListener('keydown', (event) => {
    const { target } = event;
    const field = target.matches('input:not([type=radio]):not([type=checkbox]), select, textarea');
    if (document.querySelector('dialog[open]') || event.altKey) return;
    if (event.ctrlKey || event.metaKey) return field ? undefined : history(event, shown);
    if (field) return;
    if (event.key === '?') return askHelp();
    if (!shown()) return;
    if ([' ', 'Enter'].includes(event.key) && target.matches('button, a, label, summary, input')) return;
    if (event.key.startsWith('Arrow') && target.matches('input[type=radio]')) return;
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}

/** Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y. */
function history(event, shown) {
  const key = event.key.toLowerCase();
  if (!shown() || !['z', 'y'].includes(key)) return;
  event.preventDefault();
  if (key === 'y' || event.shiftKey) shown().editor.redo(); else shown().editor.undo();
}
