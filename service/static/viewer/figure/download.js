// The download of a figure: its files are asked for as soon as they are known, while the code that draws them loads.

import { BlockFile } from './block_file.js';

/**
 * Fetch the files of a viewer document, until `signal` ends it. `model`: the bytes of a glTF, or the parts of a vertex
 * sequence; `strain`: its block file, or null; `materials`: the bytes of a glTF of them, or null, asked for after the model.
 * `onProgress` gets the share of a glTF that is fetched.
 */
export function downloadFigure(viewer, signal, onProgress = () => {}) {
  const model = viewer.kind === 'gltf' ? download(viewer.model, signal, onProgress) : vertexSequence(viewer.model);
  model.catch(() => {}); // the caller handles it
  const materials = viewer.materials ? () => download(viewer.materials, signal) : null;
  return { model, strain: viewer.strain ? strainFile(viewer.strain) : null, materials };
}

async function download(url, signal, onProgress = () => {}) {
  const answer = await fetch(url, { signal });
  if (!answer.ok) throw new Error(`${url} answered ${answer.status}`);
  const length = Number(answer.headers.get('Content-Length'));
  if (!length || answer.headers.has('Content-Encoding')) return answer.arrayBuffer(); // the length is unknown
  const bytes = new Uint8Array(length);
  let here = 0;
  for (const reader = answer.body.getReader(); ;) {
    const { done, value } = await reader.read();
    if (done) break;
    bytes.set(value, here);
    here += value.length;
    onProgress(here / length);
  }
  if (here < length) throw new Error(`${url} broke off`);
  return bytes.buffer;
}

async function vertexSequence(url) {
  const file = await BlockFile.open(url, 'int16');
  const [triangles, patches] = await Promise.all([file.array('triangles'), file.array('patches'), file.fetch(0)]);
  return { file, triangles, patches };
}

async function strainFile(url) {
  try {
    const file = await BlockFile.open(url, 'uint8');
    file.fetch(0).catch(() => {}); // fetched again when it is shown
    return file;
  } catch { return null; } // a figure without its colours is better than none
}
