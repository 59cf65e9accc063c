// The button of the clips and the menu of the other exports, always of the revision on screen.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { download } from './download.js';
import { addKeyFrameList } from './key_frame_list.js';

/** Wire the links once. `shown()` is as for `download`; null while there is no result. Answers a function that points them at it. */
export function addExportMenu(shown) {
  const menu = $('downloads').querySelector('details');
  const list = menu.querySelector('ul');
  const links = [];
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
  $('one-clip').addEventListener('click', () => {
    const { affected, segments } = shown();
    const loops = affected.some((index) => segments[index].loop); // a marked segment is saved as its best loop
    const choices = { only: affected.map((index) => index + 1).join(), keep_discarded: 'true', ...(loops && { loop: 'auto' }) };
    download(shown, 'clips', choices, note);
  });

  $('export-open').addEventListener('click', async () => {
    const { openExportPanel } = await import('./export_panel.js');
    if (shown()) openExportPanel(shown);
  });

  addKeyFrameList(() => download(shown, 'keyframes', {}, note));

  /** Have a link download an export; the address is there too, to be copied. */
  function wire(link, path) {
    link.addEventListener('click', (event) => { event.preventDefault(); download(shown, path, {}, note); });
    links.push([link, path]);
    return link;
  }

  /** Fill the menu from the service's list. */
  async function offerExports() {
    const { exports = [] } = await api.exports().catch(() => ({}));
    for (const { path, title, description } of exports) {
      if (path === 'clips') continue; // the button beside the menu
      const link = wire(make('a', {}, make('strong', {}, title), make('span', {}, description)), path);
      link.dataset.form = path.replace('result.', '');
      list.append(make('li', {}, link));
    }
    showLinks();
  }

  function showLinks() {
    if (!shown()) return;
    const { id, revision } = shown();
    if (id !== of) note('');
    of = id;
    for (const [link, path] of links) link.href = api.exportAddress(id, path, revision);
  }

  wire($('clips'), 'clips');
  offerExports();
  return showLinks;
}
