// What can be taken away, always of the revision that is shown: edits still open are kept first.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';

// The form's address below the segmentation, what it is called, what it is for, and whether a worker writes it first.
const FORMS = [
  ['keyframes', 'Key-frames', 'a GLB of the key poses', true],
  ['result.csv', 'CSV', 'a line a segment', false],
  ['result.json', 'JSON', 'everything found', false],
  ['result.npz', 'NPZ', 'arrays for NumPy', false],
  ['result.vtt', 'VTT', 'subtitles for video', false],
  ['result.eaf', 'EAF', 'annotations for ELAN', false],
  ['plot.svg', 'Plot, SVG', 'a figure for a paper', true],
  ['plot.png', 'Plot, PNG', 'the same as pixels', true],
];

/**
 * Wire the links once. `shown()` answers `{ id, name, revision, dirty, keep }`: what is on screen, whether edits are
 * open, and how to keep them.
 */
export function addExportMenu(shown) {
  const menu = $('downloads').querySelector('details');
  const list = menu.querySelector('ul');
  const links = FORMS.map(([path, title, what, waits]) => {
    const link = make('a', { onclick: (event) => save(event, link, path, waits) }, make('strong', {}, title), make('span', {}, what));
    link.dataset.form = path.replace('result.', '');
    list.append(make('li', {}, link));
    return [link, path];
  });
  const clips = $('clips');
  clips.onclick = (event) => save(event, clips, 'clips', true);
  links.push([clips, 'clips']);
  const note = (sentence) => { $('downloads-note').textContent = sentence; };
  let of = ''; // the result that was noted of
  list.addEventListener('click', () => { menu.open = false; });
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !menu.open) return;
    event.stopPropagation();
    menu.open = false;
    menu.querySelector('summary').focus();
  });
  addEventListener('pointerdown', (event) => { if (!menu.contains(event.target)) menu.open = false; });

  async function save(event, link, path, waits) {
    const { keep, dirty } = shown();
    if (!dirty && !waits) return; // the browser follows the link itself
    event.preventDefault();
    note(dirty ? 'Saving your edits first …' : 'Writing the file …');
    try {
      await keep();
      const { id, revision } = shown();
      const address = api.exportAddress(id, path, revision);
      if (waits) {
        note('Writing the file …');
        while (!(await api.isWritten(address)));
      }
      note('');
      const carrier = make('a', { href: address, download: link.download });
      carrier.click();
    } catch (problem) { note(problem.message); }
  }

  /** Point the links at what is on screen now. */
  return () => {
    const { id, revision, name } = shown();
    if (id !== of) note('');
    of = id;
    for (const [link, path] of links) {
      link.href = api.exportAddress(id, path, revision);
      if (path.startsWith('result.')) link.download = `${stem(name)}${path.slice('result'.length)}`;
    }
  };
}

const stem = (name) => (name || 'result').replace(/\.[^.]+$/, '');
