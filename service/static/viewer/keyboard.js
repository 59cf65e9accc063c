// The page by keyboard alone. A key that types into a field is the field's.

import { $ } from './dom.js';

export function keyboard({ clock, span, jump }) {
  const keys = {
    ' ': () => clock().toggle(),
    ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
    ArrowRight: (event) => step(event.shiftKey ? 10 : 1),
    Home: () => clock().seek(0),
    End: () => clock().seek(clock().frames - 1),
    ',': () => jump(-1),
    '.': () => jump(1),
    '+': () => span().zoom(1.6, clock().frame),
    '=': () => span().zoom(1.6, clock().frame),
    '-': () => span().zoom(1 / 1.6, clock().frame),
    0: () => span().all(),
    l: () => $('loop').click(),
    f: () => $('reframe').click(),
  };
  const step = (frames) => { clock().toggle(false); clock().seek(clock().frame + frames); span().reveal(clock().frame); };
  addEventListener('keydown', (event) => {
    if (!clock() || event.ctrlKey || event.metaKey || event.altKey) return;
    const { target } = event;
    if (target.matches('input:not([type=radio]):not([type=checkbox]), select, textarea')) return;
    if (event.key === ' ' && target.matches('button, a, label, summary, input')) return;
    if (event.key.startsWith('Arrow') && target.matches('input[type=radio]')) return;
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action(event);
  });
}
