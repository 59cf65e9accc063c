// The buttons that compare a result with labels of other people; the code of the track is fetched for the first file.

import { $ } from '../dom.js';

/** Wire the buttons once. `shown()` is the result on screen. */
export function addLabelButtons(shown) {
  $('labels-open').addEventListener('change', ({ target }) => {
    const [file] = target.files;
    if (file) shown()?.compareWith(file);
    target.value = '';
  });
  $('labels-open').parentElement.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' && event.key !== ' ') return;
    event.preventDefault();
    event.stopPropagation();
    $('labels-open').click();
  });
  $('labels-close').addEventListener('click', () => shown()?.labelTrack?.close());
}
