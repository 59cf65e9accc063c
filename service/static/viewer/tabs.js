// Tabs over panels, one shown at a time (the pattern of the ARIA authoring guide).

import { roving, stop } from './roving_focus.js';

/** Wire a tablist. Each tab names its panel by `aria-controls`. Answers a function that shows a tab by its id. */
export function tabs(list) {
  const all = [...list.querySelectorAll('[role=tab]')];
  const show = (id) => {
    for (const tab of all) {
      const chosen = tab.id === id;
      tab.setAttribute('aria-selected', String(chosen));
      document.getElementById(tab.getAttribute('aria-controls')).hidden = !chosen;
      if (chosen) stop(list, '[role=tab]', tab);
    }
  };
  roving(list, '[role=tab]', { horizontal: true });
  list.addEventListener('click', (event) => event.target.closest('[role=tab]') && show(event.target.closest('[role=tab]').id));
  list.addEventListener('focusin', (event) => event.target.closest('[role=tab]') && show(event.target.closest('[role=tab]').id));
  return show;
}
