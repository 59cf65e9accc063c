// Proposals: what a correction or a new cut would change, take by take, for a person to accept or to refuse.

import * as collections from '../service/collections.js';
import { $, announce, make } from '../dom.js';
import { count, duration } from '../number_format.js';
import { segmentStrip } from '../start/segment_strip.js';

const SHOWN = 8; // takes of a proposal that are drawn

/** Show the proposals of a collection that are open. `decided()` is called after a person has accepted or refused one. */
export async function showProposals(collection, decided) {
  const { proposals } = await collections.proposals(collection.id);
  const open = await Promise.all(proposals.filter(({ status }) => status === 'open').map(({ id }) => collections.proposal(collection.id, id)));
  $('proposal-cards').replaceChildren(...open.map((proposal) => card(collection, proposal, decided)));
  $('proposals').hidden = !open.length;
}

/** Wait until a proposal is worked out, and say what came of it. */
export async function awaitProposal(collection, id) {
  const { status, problem, takes } = await collections.proposal(collection.id, id);
  const sentence = {
    empty: 'Nothing else would change.',
    open: `${count(takes, 'take')} would change. Look at it, then accept or refuse it.`,
    failed: problem?.detail ?? 'It could not be worked out.',
  }[status] ?? '';
  announce(sentence);
  return sentence;
}

function card(collection, proposal, decided) {
  const { id, kind, animation, changes, changed_seconds: seconds, motions } = proposal;
  const from = collection.known(animation)?.name ?? 'a take';
  const title = kind === 'correction' ? `From your correction of ${from}` : 'A new cut of all takes together';
  const problem = make('p', { className: 'problem-line', role: 'alert' });
  const decide = (status) => collections.decide(collection.id, id, status).then(() => {
    announce(status === 'accepted' ? 'Accepted.' : 'Refused: nothing has changed.');
    return decided();
  }).catch(({ message }) => { problem.textContent = message; });
  const added = motions.length ? `, with ${count(motions.length, 'new motion')}` : '';
  return make('li', { className: 'proposal' }, make('strong', {}, title),
    make('p', {}, `${count(changes.length, 'take')} would change, ${duration(seconds)} in all${added}.`),
    make('ul', { className: 'changes' }, ...sorted(collection, changes).slice(0, SHOWN).map((change) => changeRow(collection, change))),
    changes.length > SHOWN ? make('p', { className: 'hint' }, `and ${count(changes.length - SHOWN, 'more take')}`) : null, problem,
    make('p', { className: 'ways' }, make('button', { type: 'button', className: 'primary', onclick: () => decide('accepted') }, 'Accept'),
      make('button', { type: 'button', onclick: () => decide('refused') }, 'Refuse')));
}

const nameOf = (collection, animation) => collection.known(animation)?.name ?? animation;

const sorted = (collection, changes) => changes.toSorted((one, other) =>
  nameOf(collection, one.animation).localeCompare(nameOf(collection, other.animation), 'en', { numeric: true }));

/** A take as it is, over the take as it would be. */
function changeRow(collection, { animation, segments, changed_seconds: seconds }) {
  const take = collection.known(animation);
  const frames = segments.at(-1)?.end ?? 1;
  const strip = (shown, words) => make('span', { className: 'then' }, make('small', { className: 'faint' }, words), make('span', { className: 'strip-place' }, segmentStrip(collection.coloured(shown), frames)));
  return make('li', {}, make('b', {}, nameOf(collection, animation)), make('span', { className: 'faint' }, ` ${duration(seconds)}`),
    take ? strip(take.segments, 'now') : null, strip(segments, 'then'));
}
