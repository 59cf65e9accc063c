// Lists and tabs that the Tab key stops at once: the arrows move within (the roving tabindex of the ARIA authoring guide).

/** Wire `container`: of the elements `selector` finds, one can be tabbed to; arrows, Home and End move it. */
export function addRovingFocus(container, selector, { horizontal = false } = {}) {
  const [back, on] = horizontal ? ['ArrowLeft', 'ArrowRight'] : ['ArrowUp', 'ArrowDown'];
  const items = () => [...container.querySelectorAll(selector)];
  container.addEventListener('keydown', (event) => {
    const list = items();
    const at = list.indexOf(event.target.closest(selector));
    if (at < 0) return;
    const to = { [back]: at - 1, [on]: at + 1, Home: 0, End: list.length - 1 }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation(); // the page's own arrows step frames
    const next = list[Math.max(0, Math.min(list.length - 1, to))];
    setTabStop(container, selector, next);
    next.focus();
  });
  container.addEventListener('focusin', (event) => {
    const item = event.target.closest(selector);
    if (item) setTabStop(container, selector, item);
  });
}

/** Make `item` the one that the Tab key stops at; without it, the first. */
export function setTabStop(container, selector, item = container.querySelector(selector)) {
  for (const other of container.querySelectorAll(`${selector}[tabindex="0"]`)) if (other !== item) other.tabIndex = -1;
  if (item) item.tabIndex = 0;
}

/** Wire a tablist. Each tab names its panel by `aria-controls`. Answers a function that shows a tab by its id. */
export function addTabs(list) {
  const all = [...list.querySelectorAll('[role=tab]')];
  const show = (id) => {
    for (const tab of all) {
      const chosen = tab.id === id;
      tab.setAttribute('aria-selected', String(chosen));
      document.getElementById(tab.getAttribute('aria-controls')).hidden = !chosen;
      if (chosen) setTabStop(list, '[role=tab]', tab);
    }
  };
  addRovingFocus(list, '[role=tab]', { horizontal: true });
  list.addEventListener('click', (event) => event.target.closest('[role=tab]') && show(event.target.closest('[role=tab]').id));
  list.addEventListener('focusin', (event) => event.target.closest('[role=tab]') && show(event.target.closest('[role=tab]').id));
  return show;
}
