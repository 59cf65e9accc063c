// Navigation: to segments and frames, playback and its speed, repeat, zoom, and the buttons of the figure.

import { $ } from '../dom.js';
import { setFirstFrameNumber, firstFrameNumber, parseFrame } from '../number_format.js';

/** To the first frame of a segment. */
export function goToSegment({ document, editor, playhead, range }, index) {
  const { start, end } = document.segments[index];
  editor.select(-1);
  playhead.seek(start);
  if ($('loop').checked) playhead.loop = [start, end];
  range.reveal(start);
}

/** To the segment before or after. Going back from within one goes to its own start first. */
export function goToNeighbour(result, by) {
  const { document: { segments }, playhead } = result;
  const index = result.segmentIndexAt(playhead.frame);
  const started = playhead.frame - segments[index].start > playhead.rate / 2;
  goToSegment(result, by < 0 && started ? index : Math.max(0, Math.min(segments.length - 1, index + by)));
}

/** Show the segment at a frame alone, with a little around it; the whole take where that is shown already. */
export function zoomToSegment(result, frame = result.playhead.frame) {
  const { range, document: { segments } } = result;
  const { start, end } = segments[result.segmentIndexAt(frame)];
  const around = Math.max(4, (end - start) * 0.06);
  const near = range.from >= start - 2 * around && range.to <= end + 2 * around;
  if (near) range.showAll(); else range.set(start - around, end + around);
}

/** Repeat the current segment, or stop repeating it. */
export function repeatSegment(result, on) {
  const { start, end } = result.document.segments[result.segmentIndexAt(result.playhead.frame)];
  result.playhead.loop = on ? [start, end] : null;
}

/** Wire the buttons of the player once. */
export function addPlayerControls(shown) {
  const on = (id, event, action) => $(id).addEventListener(event, action);
  const frame = $('frame');
  on('play', 'click', () => shown().playhead.toggle());
  on('previous', 'click', () => goToNeighbour(shown(), -1));
  on('next', 'click', () => goToNeighbour(shown(), 1));
  on('speed', 'change', (event) => { shown().playhead.speed = Number(event.target.value); });
  on('loop', 'change', (event) => repeatSegment(shown(), event.target.checked));
  on('frame', 'focus', () => frame.select());
  on('frame', 'keydown', (event) => { if (event.key === 'Enter' || event.key === 'Escape') frame.blur(); });
  on('frame', 'change', () => {
    const typed = parseFrame(frame.value);
    if (typed !== null) { shown().playhead.seek(typed); shown().range.reveal(shown().playhead.frame); }
  });
  on('frame', 'blur', () => shown()?.playhead.notify()); // what was typed and is no frame goes back to the one shown
  $('count-one').checked = firstFrameNumber() === 1;
  on('count-one', 'change', (event) => setFirstFrameNumber(event.target.checked ? 1 : 0));
}

/** Wire the buttons of the zoom and of the figure once. */
export function addViewControls(shown) {
  const on = (id, event, action) => $(id).addEventListener(event, action);
  const zoom = (factor) => shown().range.zoom(factor, shown().playhead.frame);
  on('zoom-in', 'click', () => zoom(1.6));
  on('zoom-out', 'click', () => zoom(1 / 1.6));
  on('zoom-segment', 'click', () => zoomToSegment(shown()));
  on('zoom-fit', 'click', () => shown().range.showAll());
  on('reframe', 'click', () => shown().figurePanel.scene?.reframe());
  on('follow', 'change', (event) => { if (shown().figurePanel.scene) shown().figurePanel.scene.following = event.target.checked; });
  for (const button of document.querySelectorAll('[data-side]')) {
    button.addEventListener('click', () => shown().figurePanel.scene?.lookFrom(button.dataset.side));
  }
  on('ghosts', 'change', () => shown().figurePanel.show());
  on('upright', 'click', (event) => {
    const pressed = event.target.getAttribute('aria-pressed') !== 'true';
    event.target.setAttribute('aria-pressed', String(pressed));
    shown().figurePanel.scene?.setUpAxis(pressed);
  });
  on('looks', 'change', (event) => shown().figurePanel.colourBy(event.target.value));
}
