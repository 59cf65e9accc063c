// The REST calls of collections.

import { call, json } from './api.js';

const at = (id) => `/v1/collections/${id}`;
const waiting = (seconds) => ({ Prefer: `wait=${seconds}` });

/** The newest collections, without their takes. */
export const collections = () => call('GET', '/v1/collections?limit=12');
export const createCollection = (name, animations) => call('POST', '/v1/collections', json({ name, animations }));
export const collection = (id) => call('GET', at(id));
export const renameCollection = (id, name) => call('PATCH', at(id), json({ name }));
export const deleteCollection = (id) => call('DELETE', at(id));

/** Change the name or the colour of a motion, in all takes at once. */
export const changeMotion = (id, motion, changes) => call('PATCH', `${at(id)}/motions/${motion}`, json(changes));

/** A page of takes; `next` is the address of the page after it. */
export const takes = (id) => call('GET', `${at(id)}/takes?limit=100`);
export const take = (id, animation) => call('GET', `${at(id)}/takes/${animation}`);
export const addTakes = (id, animations) => call('POST', `${at(id)}/takes`, json({ animations }));
export const removeTake = (id, animation) => call('DELETE', `${at(id)}/takes/${animation}`);

/** Set the segments of a take; 412 if somebody else has changed it since `version`. */
export function correctTake(id, { animation, version }, segments) {
  const { body, headers } = json({ segments });
  return call('PATCH', `${at(id)}/takes/${animation}`, { body, headers: { ...headers, 'If-Match': `"${version}"` } });
}

export const proposals = (id) => call('GET', `${at(id)}/proposals`);
export const proposal = (id, number) => untilWorked(`${at(id)}/proposals/${number}`);
export const proposeRecut = (id, motions) => call('POST', `${at(id)}/proposals`, json({ motions }));
export const decide = (id, number, status) => call('PATCH', `${at(id)}/proposals/${number}`, json({ status }));

/** The ranges like an example, nearest first. */
export async function search(id, example) {
  const { links } = await call('POST', `${at(id)}/searches`, json(example));
  return untilWorked(links.self);
}

/** What stands at an address once the service has worked it out. */
async function untilWorked(address) {
  for (;;) {
    const answer = await call('GET', address, { headers: waiting(20) });
    if (answer.status !== 'working') return answer;
  }
}
