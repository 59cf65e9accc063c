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

function animationFacts({ format, take_count: takes, duration_seconds: seconds, triangles, created }) {
  return [
    format && format.toUpperCase(),
    seconds !== null && duration(seconds),
    takes > 1 && count(takes, 'take'),
    triangles ? count(triangles, 'triangle') : null,
    created && ago(created),
  ].filter(Boolean).join(' · ');
}
