// Files that are dropped on a collection: each is sent, then labelled. One that is refused is named, and stops no other.

import * as api from '../service/api.js';
import * as collections from '../service/collections.js';
import { $, make } from '../dom.js';

const AT_ONCE = 2; // that are being sent

/** Send groups of files, each one animation, and add them. `added()` is called after each. */
export async function addToCollection(id, groups, added) {
  const left = groups.map((group) => ({ group, ...additionRow(group[0].name) }));
  $('collection-additions').append(...left.map(({ item }) => item));
  $('collection-additions').hidden = false;
  const work = async () => { while (left.length) await add(id, left.shift(), added); };
  await Promise.all(Array.from({ length: AT_ONCE }, work));
}

async function add(id, { group, item, say }, added) {
  try {
    const { id: animation } = await api.upload(group, (share) => say(`Sending, ${Math.round(100 * share)} %`));
    await collections.addTakes(id, [animation]);
    item.remove();
    $('collection-additions').hidden = !$('collection-additions').children.length;
    await added();
  } catch ({ message }) { say(message, true); }
}

function additionRow(name) {
  const note = make('span', { className: 'row-note', role: 'status' }, 'Waiting');
  const close = make('button', { type: 'button', hidden: true, onclick: () => item.remove() }, 'Close', make('span', { className: 'unseen' }, ` ${name}`));
  const item = make('li', {}, make('strong', {}, name), note, close);
  const say = (sentence, bad = false) => {
    note.textContent = sentence;
    note.classList.toggle('problem-line', bad);
    close.hidden = !bad;
  };
  return { item, say };
}
