// The card of an animation: what it is, and its segments as they were cut or edited last.

import * as api from '../service/api.js';
import { make } from '../dom.js';
import { ago, count, duration } from '../number_format.js';
import { segmentStrip } from './segment_strip.js';

/** A list item. `open(animation)`, `rename(animation, renamed)` and `remove(animation, card)` are called when a person asks. */
export function animationCard(animation, { open, rename, remove }) {
  const name = make('strong', {}, animation.name);
  const result = make('span', { className: 'result-facts' });
  const strip = make('span', { className: 'strip-place' });
  const card = make('li', { className: 'card' },
    make('button', { type: 'button', className: 'animation', onclick: () => open(animation) }, strip, name,
      make('span', { className: 'facts' }, ...factsApart(animationFacts(animation))), result),
    cardMenu(animation.name, [
      ['Rename', () => rename(animation, (renamed) => { Object.assign(animation, renamed); name.textContent = animation.name; })],
      ['Delete', () => remove(animation, card)],
    ]));
  whenSeen(card, () => showResult(animation, strip, result));
  return card;
}

/** The menu of a card: pairs of a text and what it does. */
export function cardMenu(name, ways) {
  const details = make('details', { className: 'menu more' }, make('summary', { 'aria-label': `More for ${name}`, title: 'Rename or delete' }, '⋯'),
    make('ul', {}, ...ways.map(([text, action]) => make('li', {},
      make('button', { type: 'button', onclick: () => { details.open = false; action(); } }, text)))));
  details.addEventListener('focusout', ({ relatedTarget }) => { if (!details.contains(relatedTarget)) details.open = false; });
  return details;
}

/** Call back once an element comes into view. */
function whenSeen(element, action) {
  const observer = new IntersectionObserver((seen) => {
    if (!seen.some(({ isIntersecting }) => isIntersecting)) return;
    observer.disconnect();
    action();
  }, { rootMargin: '200px' });
  observer.observe(element);
}

/** Show the segments of the result that the card opens. */
async function showResult(animation, strip, facts) {
  try {
    const id = animation.edited ?? (await api.segmentationsOf(animation.id)).segmentations.find(({ status }) => status === 'done')?.id;
    if (!id) return;
    const { frames, revision } = await api.status(id);
    const { segments } = await api.revision(id, revision);
    showPoster(strip.parentElement, id);
    const motions = new Set(segments.map(({ motion }) => motion)).size;
    strip.replaceChildren(segmentStrip(segments, frames));
    facts.replaceChildren(`${count(motions, 'motion')}, ${count(segments.length, 'segment')}`,
      revision ? make('b', { className: 'edited' }, 'edited') : '');
  } catch { /* the card still opens, and then says what is wrong */ }
}

/** Facts with dots between them; a line may end after a dot, and never within a fact. */
export const factsApart = (facts) => facts.flatMap((fact, i) => [i ? ' ' : null, make('span', {}, i < facts.length - 1 ? `${fact} ·` : fact)]);

/** Show the picture that is kept with a result; a card of one that nobody has opened yet has none. */
function showPoster(button, id) {
  const picture = make('img', { className: 'poster', alt: '', src: api.posterAddress(id) });
  picture.addEventListener('load', () => { button.classList.add('pictured'); button.append(picture); });
}

function animationFacts({ format, take_count: takes, duration_seconds: seconds, created }) {
  return [
    format && format.toUpperCase(),
    seconds !== null && duration(seconds),
    takes > 1 && count(takes, 'take'),
    created && ago(created),
  ].filter(Boolean);
}
