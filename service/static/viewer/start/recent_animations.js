// The list of recent animations, newest first.

import * as api from '../service/api.js';
import { $, make } from '../dom.js';
import { ago, count, duration } from '../number_format.js';

const MOST = 12;

/** Fill the list. `open(animation)` is called for the one chosen. Stays hidden where there is nothing. */
export async function showRecent(open) {
  const answer = await api.recentAnimations().catch(() => null);
  const animations = (answer?.animations || []).slice(0, MOST);
  $('recent').hidden = !animations.length;
  $('recent').querySelector('ul').replaceChildren(...animations.map((animation) => make('li', {},
    make('button', { type: 'button', className: 'animation', onclick: () => open(animation) },
      make('strong', {}, animation.name || 'unnamed'),
      make('span', {}, animationFacts(animation))))));
}

function animationFacts({ format, takes = [], triangles, created }) {
  const longest = takes.reduce((best, take) => (take.duration_seconds > (best?.duration_seconds ?? -1) ? take : best), null);
  return [
    format && format.toUpperCase(),
    longest && duration(longest.duration_seconds),
    takes.length > 1 && count(takes.length, 'take'),
    triangles ? count(triangles, 'triangle') : null,
    created && ago(created),
  ].filter(Boolean).join(' · ');
}
