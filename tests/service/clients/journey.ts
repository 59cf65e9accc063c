// The journey of a client whose types openapi-typescript generated: `node journey.js URL FILE`.
import { readFile } from 'node:fs/promises';
import createClient from 'openapi-fetch';
import type { components, paths } from './schema';

type Status = components['schemas']['StatusDocument'];

const [address, path] = process.argv.slice(2) as [string, string];
const api = createClient<paths>({ baseUrl: address });

function check(holds: unknown, what: string): asserts holds {
  if (!holds) throw new Error(what);
}

interface Answer<T> { data?: T; error?: components['schemas']['Problem']; response: Response }

function got<T>({ data, error, response }: Answer<T>): T {
  check(data !== undefined, `${response.status} ${response.url}: ${error?.detail ?? ''}`);
  return data;
}

const bytes = (whole: ArrayBuffer, length: number): string => Buffer.from(whole).subarray(0, length).toString('latin1');

const file = await readFile(path);
const form = new FormData();
form.append('file', new Blob([file]), 'journey.glb');
const animation = got(await api.POST('/v1/animations', {
  body: { file: [] },
  bodySerializer: () => form,
}));
check(animation.takes[0]?.frames === 240, 'the take has 240 frames');

const submitted: Status = got(await api.POST('/v1/segmentations', {
  body: { animation: animation.id },
  params: { header: { Prefer: 'wait=30' } },
}));
const place = { params: { path: { identifier: submitted.id }, header: { Prefer: 'wait=30' } } };
const status = got(await api.GET('/v1/segmentations/{identifier}', place));
check(status.status === 'done', `it is ${status.status}`);

const result = '/v1/segmentations/{identifier}/result' as const;
const document = got(await api.GET(result, place));
check(typeof document !== 'string' && 'energy' in document, 'the document comes where anything will do');
check(document.segments.at(-1)?.end === 240, 'the segments cover the take');
check(got(await api.GET(`${result}.json`, place)).frames === 240, 'JSON');
check(got(await api.GET(`${result}.csv`, { ...place, parseAs: 'text' })).startsWith('name,motion'), 'CSV');
check(got(await api.GET(`${result}.vtt`, { ...place, parseAs: 'text' })).startsWith('WEBVTT'), 'VTT');
check(got(await api.GET(`${result}.eaf`, { ...place, parseAs: 'text' })).includes('<ANNOTATION_DOCUMENT'), 'EAF');
check(bytes(got(await api.GET(`${result}.npz`, { ...place, parseAs: 'arrayBuffer' })), 2) === 'PK', 'NPZ');
const plot = '/v1/segmentations/{identifier}/plot' as const;
check(bytes(got(await api.GET(`${plot}.svg`, { ...place, parseAs: 'arrayBuffer' })), 400).includes('<svg'), 'SVG');
check(bytes(got(await api.GET(`${plot}.png`, { ...place, parseAs: 'arrayBuffer' })), 4) === '\x89PNG', 'PNG');

const revision = got(await api.POST('/v1/segmentations/{identifier}/revisions', {
  params: { path: { identifier: submitted.id }, header: { 'If-Match': '"0"' } },
  body: { segments: [{ start: 0, end: 240, motion: 0, name: 'all' }] },
}));
check(revision.segments[0]?.name === 'all', 'the revision is kept');

const choices = { params: { ...place.params, query: { revision: 'latest' } } };
const clips = await api.GET('/v1/segmentations/{identifier}/clips', { ...choices, parseAs: 'arrayBuffer' });
check(bytes(got(clips), 4) === 'glTF', 'clips');

const cut = { params: { path: { identifier: submitted.id } } };
const upload = { params: { path: { identifier: animation.id } } };
check((await api.DELETE('/v1/segmentations/{identifier}', cut)).response.status === 204, 'the segmentation goes');
check((await api.DELETE('/v1/animations/{identifier}', upload)).response.status === 204, 'the animation goes');
const gone = await api.GET('/v1/animations/{identifier}', upload);
check(gone.error?.code === 'not-found', 'nothing is left');
