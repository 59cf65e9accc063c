// Links to what is on screen: one to look at it, and one to edit it.

import { $, announce } from '../dom.js';
import { lookOnly } from '../views.js';

/** Wire the menu once. `shown()` is `{ id, revision, frame }`. */
export function addSharing(shown) {
  const menu = $('share');
  for (const button of menu.querySelectorAll('[data-link]')) {
    button.addEventListener('click', async () => {
      menu.open = false;
      const address = linkTo(shown(), button.dataset.link === 'look');
      await navigator.clipboard.writeText(address).then(() => say('Copied'), () => prompt('Copy this link:', address));
    });
  }
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !menu.open) return;
    event.stopPropagation();
    menu.open = false;
    menu.querySelector('summary').focus();
  });
  addEventListener('pointerdown', (event) => { if (!menu.contains(event.target)) menu.open = false; });
}

/** The address of what is shown; who only looks sees the revision of now, whatever comes after. */
export function linkTo({ id, revision, frame }, look) {
  const query = look ? `?${revision ? `revision=${revision}&` : ''}look=1` : '';
  return `${location.origin}/view/${id}${query}#frame=${frame}`;
}

/** Show whether this page is only to look at, and the way to edit. */
export function showLookOnly() {
  document.body.classList.toggle('look-only', lookOnly());
  $('look-note').hidden = !lookOnly();
  $('look-edit').href = location.pathname + location.hash;
}

function say(word) {
  const label = $('share').querySelector('summary');
  label.textContent = word;
  announce('The link is copied.');
  setTimeout(() => { label.textContent = 'Copy link'; }, 1500);
}
