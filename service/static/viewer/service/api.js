// The REST calls of the page. The page is a client like any other: curl can do all of this.

import { waitForSignIn } from './sign_in.js';

/** A refusal, with the problem document (RFC 9457) it came with. */
export class Problem extends Error {
  constructor(document) {
    super(document.detail || document.title || 'The service gave no reason.');
    this.document = document;
  }
}

const UNREACHABLE = { code: 'unreachable', detail: 'The service does not answer. Is it running, and is the network up?' };

/** One call: its answer as JSON, null where there is none. Throws `Problem`. */
export async function call(method, path, { body, headers, signal } = {}) {
  let answer;
  try {
    answer = await fetch(path, { method, body, headers, signal });
  } catch (failure) {
    if (failure.name === 'AbortError') throw failure;
    throw new Problem(UNREACHABLE);
  }
  if (answer.status === 401) { await waitForSignIn(); return call(method, path, { body, headers, signal }); }
  if (!answer.ok) throw new Problem(await problemOf(answer));
  return answer.status === 204 ? null : answer.json();
}

async function problemOf(answer) {
  const text = await answer.text();
  return parsedProblem(text, answer.status);
}

function parsedProblem(text, status) {
  try {
    const document = JSON.parse(text);
    if (document && document.detail) return document;
  } catch { /* not ours: a proxy's page, or nothing */ }
  return { status, code: `http-${status}`, detail: `The service answered ${status} without saying why.` };
}

/** A body of JSON, for `call`. */
export const json = (value) => ({ body: JSON.stringify(value), headers: { 'Content-Type': 'application/json' } });

/** A page of animations whose names hold `search`; `next` is the address of the page after it. */
export const animations = (search = '', limit = 24) => call('GET', `/v1/animations?limit=${limit}${search ? `&search=${encodeURIComponent(search)}` : ''}`);
export const more = (next) => call('GET', next);
export const animation = (id) => call('GET', `/v1/animations/${id}`);
export const rename = (id, name) => call('PATCH', `/v1/animations/${id}`, json({ name }));
export const deleteAnimation = (id) => call('DELETE', `/v1/animations/${id}`);
export const segmentationsOf = (id) => call('GET', `/v1/segmentations?animation=${id}&limit=100`);
export const segmentations = () => call('GET', '/v1/segmentations?limit=100');
export const methods = () => call('GET', '/v1/methods');
export const exports = () => call('GET', '/v1/exports');
export const status = (id, wait, signal) =>
  call('GET', `/v1/segmentations/${id}`, { headers: wait ? { Prefer: `wait=${wait}` } : {}, signal });
export const result = (id, revision = 0) =>
  call('GET', `/v1/segmentations/${id}/result${revisionQuery(revision)}`, { headers: { Accept: 'application/json' } });
export const revision = (id, number) => call('GET', `/v1/segmentations/${id}/revisions/${number}`);
export const revisions = (id) => call('GET', `/v1/segmentations/${id}/revisions`);
export const pictures = (id) => call('GET', `/v1/segmentations/${id}/pictures`);
export const keepPictures = (id, kept) => call('PUT', `/v1/segmentations/${id}/pictures`, json(kept));
export const posterAddress = (id) => `/v1/segmentations/${id}/poster`;
export const viewer = (id) => call('GET', `/v1/segmentations/${id}/viewer`);
export const cancel = (id) => call('DELETE', `/v1/segmentations/${id}`);
export const segment = (animationId, parameters = {}) =>
  call('POST', '/v1/segmentations', json({ animation: animationId, ...parameters }));

/** The address of an export of a revision: `result.csv`, `clips`, `plot.svg`; `choices` are those of clips. */
export const exportAddress = (id, name, revision = 0, choices = {}) => `/v1/segmentations/${id}/${name}${revisionQuery(revision, choices)}`;

/** The clips that there would be with `choices`. */
export const clipPlan = (id, revision, choices) => call('GET', exportAddress(id, 'clips/plan', revision, choices));

function revisionQuery(revision, choices = {}) {
  const query = new URLSearchParams({ ...(revision ? { revision } : {}), ...choices }).toString();
  return query && `?${query}`;
}

/**
 * Save edited segments as the revision after number `newest`; 412 if somebody else has saved one since. The answer has the loops that
 * a worker finds in segments that were cut otherwise, if it finds them soon.
 */
export function revise(id, segments, newest, note) {
  const sent = segments.map(({ start, end, motion, name, loop, discard }) =>
    ({ start, end, motion, name, loop: Boolean(loop), discard: Boolean(discard) }));
  const { body, headers } = json({ segments: sent, note });
  return call('POST', `/v1/segmentations/${id}/revisions`, { body, headers: { ...headers, 'If-Match': `"${newest}"`, Prefer: 'wait=3' } });
}

/** Wait a while for a worker to write an export; answers whether it is written. */
export async function isWritten(address) {
  const answer = await fetch(address, { headers: { Prefer: 'wait=30', Range: 'bytes=0-0' } }).catch(() => null);
  if (!answer) throw new Problem(UNREACHABLE);
  if (!answer.ok) throw new Problem(await problemOf(answer));
  return answer.status !== 202;
}

/**
 * Upload one file as the body, several as a form. `onProgress` gets the share that is sent.
 * XMLHttpRequest, because fetch cannot say how much of a body is sent.
 */
export function upload(files, onProgress, signal) {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    const name = encodeURIComponent(files[0].name);
    request.open('POST', files.length === 1 ? `/v1/animations?name=${name}` : '/v1/animations');
    request.upload.onprogress = (event) => event.lengthComputable && onProgress(event.loaded / event.total);
    request.onerror = () => reject(new Problem(UNREACHABLE));
    request.onabort = () => reject(new DOMException('cancelled', 'AbortError'));
    request.onload = () => {
      if (request.status < 300) resolve(JSON.parse(request.responseText));
      else reject(new Problem(parsedProblem(request.responseText, request.status)));
    };
    signal?.addEventListener('abort', () => request.abort());
    if (files.length === 1) {
      request.setRequestHeader('Content-Type', 'application/octet-stream');
      request.send(files[0]);
    } else {
      const form = new FormData();
      for (const file of files) form.append('files', file, file.name);
      request.send(form);
    }
  });
}
