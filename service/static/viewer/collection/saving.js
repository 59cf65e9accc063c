// What a person takes away: all segments as CSV or JSON, and a take's clips by the common names.

import * as api from '../service/api.js';
import { make } from '../dom.js';

/** Save all takes of a collection as `csv` or `json`. */
export async function saveCollection(collection, form) {
  await collection.all();
  const { document: { id, name, motions }, takes } = collection;
  const kept = takes.map(({ animation, name: take, status, frames, frame_rate: rate, segments }) =>
    ({ animation, name: take, status, frames, frame_rate: rate, segments: named(collection, segments) }));
  const text = form === 'csv' ? csvOf(kept) : JSON.stringify({ id, name, motions, takes: kept }, null, 1);
  const address = URL.createObjectURL(new Blob([text], { type: form === 'csv' ? 'text/csv' : 'application/json' }));
  make('a', { href: address, download: `${name.replace(/[^\p{L}\p{N}._-]+/gu, '_')}.${form}` }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}

const named = (collection, segments) => segments.map((segment) => ({ ...segment, name: collection.motion(segment.motion).name }));

function csvOf(takes) {
  const lines = takes.flatMap(({ name, segments }) => segments.map((segment, place) =>
    [name, place + 1, segment.name, segment.start, segment.end, segment.start_seconds, segment.end_seconds, segment.confidence ?? '', segment.corrected]));
  return [['take', 'segment', 'motion', 'start', 'end', 'start_seconds', 'end_seconds', 'confidence', 'corrected'], ...lines]
    .map((line) => line.map(field).join()).join('\r\n') + '\r\n';
}

/** A field of a CSV that no spreadsheet takes for a formula. */
function field(value) {
  const text = typeof value === 'string' ? value.replace(/^(?=[=+\-@\t\r])/, "'") : String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** Save the clips of a take by the common names, which become a revision of it. `note(sentence)` says what is waited for. */
export async function saveClips(collection, take, note) {
  note('Writing the file …');
  try {
    const numbers = new Map(collection.document.motions.map(({ id }, place) => [id, place]));
    const segments = named(collection, take.segments).map(({ start, end, motion, name }) => ({ start, end, motion: numbers.get(motion), name }));
    const { revision: newest } = await api.status(take.segmentation);
    const { revision } = await api.revise(take.segmentation, segments, newest, `named as in ${collection.document.name}`);
    const address = api.exportAddress(take.segmentation, 'clips', revision);
    while (!(await api.isWritten(address)));
    note('');
    make('a', { href: address, download: '' }).click();
  } catch ({ message }) { note(message); }
}
