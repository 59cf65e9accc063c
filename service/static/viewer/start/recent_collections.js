// The newest collections as cards on the first screen.

import * as collections from '../service/collections.js';
import { $, make } from '../dom.js';
import { ago, count } from '../number_format.js';
import { swatchOf, textureNumber } from '../palette.js';
import { cardMenu, factsApart } from './animation_card.js';

/** List them; the list stays hidden where there is none. `open(id)` is called for the one chosen. */
export async function showCollections(open) {
  const { collections: found } = await collections.collections().catch(() => ({ collections: [] }));
  $('collections').hidden = !found.length;
  $('collection-cards').replaceChildren(...found.map((collection) => card(collection, open)));
}

function card({ id, name, takes, motions, updated }, open) {
  const marks = make('span', { className: 'marks-line' }, ...motions.slice(0, 24).map(({ colour }, place) => swatchOf(colour, textureNumber(place))));
  const item = make('li', { className: 'card' },
    make('button', { type: 'button', className: 'animation', onclick: () => open(id) }, marks, make('strong', {}, name),
      make('span', { className: 'facts' }, ...factsApart([count(takes, 'take'), count(motions.length, 'motion'), ago(updated)]))),
    cardMenu(name, [['Delete', () => remove({ id, name }, item)]]));
  return item;
}

async function remove({ id, name }, item) {
  if (!confirm(`Delete the collection ${name}? Its animations stay.`)) return;
  await collections.deleteCollection(id).then(() => item.remove(), ({ message }) => alert(message));
}
