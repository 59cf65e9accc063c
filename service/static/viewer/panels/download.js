// Downloading a file of the revision on screen: open edits are saved first, and a worker may have to write the file.

import * as api from '../service/api.js';
import { make } from '../dom.js';

/**
 * Download the export `path`, with `choices` of clips. `shown` is what is on screen, `{ id, revision, dirty, keep }` (how to save
 * open edits is `keep`), read anew after they are saved. `note(sentence)` says what is waited for, and what went wrong.
 */
export async function download(shown, path, choices, note) {
  const { keep, dirty } = shown();
  note(dirty ? 'Saving your edits first …' : 'Writing the file …');
  try {
    await keep();
    const { id, revision } = shown();
    const address = api.exportAddress(id, path, revision, choices);
    note('Writing the file …');
    while (!(await api.isWritten(address))); // and where nobody answers, the note says so
    note('');
    make('a', { href: address, download: '' }).click(); // the service names the file
  } catch (problem) { note(problem.message); }
}
