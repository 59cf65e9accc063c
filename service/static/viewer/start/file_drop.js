// Files of a person: by drop, by choice and by paste, anywhere on the page.

import { $ } from '../dom.js';

/** Call `open(files)` whenever a person gives files. */
export function acceptFiles(open) {
  const given = (files) => files.length && open([...files]);
  for (const label of [$('drop'), $('another'), $('collection-add')]) {
    const input = label.querySelector('input');
    input.addEventListener('change', () => { given(input.files); input.value = ''; });
    label.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); input.click(); }
    });
  }
  let depth = 0; // of nested elements entered: leaving a child is not leaving the page
  const cover = (shown) => { $('cover').hidden = !shown; };
  const hasFiles = (event) => event.dataTransfer?.types.includes('Files');
  addEventListener('dragenter', (event) => { if (hasFiles(event)) { depth += 1; cover(true); } });
  addEventListener('dragleave', (event) => { if (hasFiles(event)) { depth -= 1; cover(depth > 0); } });
  addEventListener('dragover', (event) => hasFiles(event) && event.preventDefault());
  addEventListener('drop', (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    depth = 0;
    cover(false);
    given(event.dataTransfer.files);
  });
  addEventListener('paste', (event) => event.clipboardData?.files && given(event.clipboardData.files));
}
