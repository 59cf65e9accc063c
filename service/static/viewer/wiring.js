// Every control of the result, wired once: what stands in the page stays, what it acts on changes.

import { countFrom, countsFrom, typedFrame } from './frame_numbering.js';
import { $ } from './dom.js';
import { downloads } from './panels/export_menu.js';
import { editBar } from './editing/edit_toolbar.js';
import { help } from './help.js';
import { keyboard } from './keyboard.js';
import { segmentList } from './panels/segment_list.js';
import { reviewTools } from './panels/cut_review.js';
import { revisionList, showRevisions } from './panels/revision_list.js';
import { tabs } from './tabs.js';
import { jump, loop } from './timeline/navigation.js';

/** `shown()` is the result on screen, or null. Answers a function to call whenever what is shown has changed. */
export function wire({ shown, openRevision }) {
  playback(shown);
  view(shown);
  const showTab = tabs($('tabs'));
  segmentList();
  revisionList();
  reviewTools(() => { showTab('tab-review'); return shown()?.review; });
  keyboard(shown, help());
  const editor = () => shown()?.editor;
  const showEdits = editBar(editor, { loadTheirs: () => openRevision(editor().saving.theirs, true) });
  const showLinks = downloads(() => {
    const { saving } = editor();
    return { id: shown().document.id, name: shown().status.name, revision: saving.shown, dirty: saving.open, keep: () => saving.flush() };
  });
  addEventListener('beforeunload', (event) => { if (editor()?.saving.open) event.preventDefault(); });
  addEventListener('visibilitychange', () => { if (document.hidden && editor()?.saving.kind === 'waiting') editor().saving.flush().catch(() => {}); });
  let listed = '';
  return () => {
    if (!editor()) return;
    showEdits();
    showLinks();
    const { saving } = editor();
    const state = `${shown().document.id} ${saving.shown} ${saving.newest}`;
    if (state === listed) return;
    listed = state;
    showRevisions(shown().document.id, saving.shown, openRevision);
    if (location.search && saving.shown === saving.newest) history.replaceState(null, '', location.pathname + location.hash);
  };
}

function playback(shown) {
  const on = (id, event, action) => $(id).addEventListener(event, action);
  const frame = $('frame');
  on('play', 'click', () => shown().clock.toggle());
  on('previous', 'click', () => jump(shown(), -1));
  on('next', 'click', () => jump(shown(), 1));
  on('speed', 'change', (event) => { shown().clock.speed = Number(event.target.value); });
  on('loop', 'change', (event) => loop(shown(), event.target.checked));
  on('frame', 'focus', () => frame.select());
  on('frame', 'keydown', (event) => { if (event.key === 'Enter' || event.key === 'Escape') frame.blur(); });
  on('frame', 'change', () => {
    const typed = typedFrame(frame.value);
    if (typed !== null) { shown().clock.seek(typed); shown().span.reveal(shown().clock.frame); }
  });
  on('frame', 'blur', () => shown()?.clock.tell()); // what was typed and is no frame goes back to the one shown
  $('count-one').checked = countsFrom() === 1;
  on('count-one', 'change', (event) => countFrom(event.target.checked ? 1 : 0));
}

function view(shown) {
  const on = (id, event, action) => $(id).addEventListener(event, action);
  const zoom = (factor) => shown().span.zoom(factor, shown().clock.frame);
  on('zoom-in', 'click', () => zoom(1.6));
  on('zoom-out', 'click', () => zoom(1 / 1.6));
  on('zoom-fit', 'click', () => shown().span.all());
  on('reframe', 'click', () => shown().presence.stage?.reframe());
  on('follow', 'change', (event) => { if (shown().presence.stage) shown().presence.stage.following = event.target.checked; });
  on('upright', 'click', (event) => {
    const pressed = event.target.getAttribute('aria-pressed') !== 'true';
    event.target.setAttribute('aria-pressed', String(pressed));
    shown().presence.stage?.turn(pressed);
  });
  on('looks', 'change', (event) => shown().presence.look(event.target.value));
}
