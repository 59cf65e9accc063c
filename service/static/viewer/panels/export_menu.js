// The button of the clips and the menu of the other exports, always of the revision on screen: open edits are saved first.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';

/**
 * Wire the links once. `shown()` answers `{ id, name, revision, dirty, keep }`: what is on screen, whether edits are
 * open, and how to save them; null while there is no result.
 */
export function addExportMenu(shown) {
  const menu = $('downloads').querySelector('details');
  const list = menu.querySelector('ul');
  const clips = $('clips');
  clips.onclick = (event) => save(event, clips, 'clips', true);
  const links = [[clips, 'clips']];
  const note = (sentence) => { $('downloads-note').textContent = sentence; };
  let of = ''; // the result that the note is about
  list.addEventListener('click', () => { menu.open = false; });
  menu.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || !menu.open) return;
    event.stopPropagation();
    menu.open = false;
    menu.querySelector('summary').focus();
  });
  addEventListener('pointerdown', (event) => { if (!menu.contains(event.target)) menu.open = false; });

  async function save(event, link, path, queued) {
    const { keep, dirty } = shown();
    if (!dirty && !queued) return; // the browser follows the link itself
    event.preventDefault();
    note(dirty ? 'Saving your edits first …' : 'Writing the file …');
    try {
      await keep();
      const { id, revision } = shown();
      const address = api.exportAddress(id, path, revision);
      if (queued) {
        note('Writing the file …');
        while (!(await api.isWritten(address)));
      }
      note('');
      const carrier = make('a', { href: address, download: link.download });
      carrier.click();
    } catch (problem) { note(problem.message); }
  }

  /** Fill the menu from the service's list. */
  async function offerExports() {
    const answer = await api.exports().catch(() => null);
    for (const { path, title, description, queued } of answer?.exports ?? []) {
      if (path === 'clips') continue; // the button beside the menu
      const link = make('a', { onclick: (event) => save(event, link, path, queued) }, make('strong', {}, title), make('span', {}, description));
      link.dataset.form = path.replace('result.', '');
      list.append(make('li', {}, link));
      links.push([link, path]);
    }
    showLinks();
  }

  /** Point the links at the result and the revision on screen. */
  function showLinks() {
    if (!shown()) return;
    const { id, revision, name } = shown();
    if (id !== of) note('');
    of = id;
    for (const [link, path] of links) {
      link.href = api.exportAddress(id, path, revision);
      if (path.startsWith('result.')) link.download = `${stem(name)}${path.slice('result'.length)}`;
    }
  }

  offerExports();
  return showLinks;
}

const stem = (name) => (name || 'result').replace(/\.[^.]+$/, '');
