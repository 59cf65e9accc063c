// Moving along a take: to segments and frames, at a speed, again and again, nearer or farther; and about the figure.

import { $ } from '../dom.js';
import { countFrom, countsFrom, typedFrame } from '../number_format.js';

/** To the first frame of a segment. */
export function goTo({ document, editor, clock, span }, index) {
  const { start, end } = document.segments[index];
  editor.select(-1);
  clock.seek(start);
  if ($('loop').checked) clock.loop = [start, end];
  span.reveal(start);
}

/** To the segment before or after. Going back from within one goes to its own start first. */
export function jump(result, by) {
  const { document: { segments }, clock } = result;
  const index = result.indexAt(clock.frame);
  const started = clock.frame - segments[index].start > clock.rate / 2;
  goTo(result, by < 0 && started ? index : Math.max(0, Math.min(segments.length - 1, index + by)));
}

/** Play the segment of the moment again and again, or go on from it. */
export function loop(result, on) {
  const { start, end } = result.document.segments[result.indexAt(result.clock.frame)];
  result.clock.loop = on ? [start, end] : null;
}

/** Wire the buttons of the player once. */
export function playback(shown) {
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

/** Wire the buttons of the zoom and of the figure once. */
export function view(shown) {
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
