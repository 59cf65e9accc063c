// What the figure is made of, on its way: asked for as soon as it is known, beside the code that draws it.

import { BlockFile } from './block_file.js';

/**
 * Ask for what a viewer document names, until `signal` ends it. `model`: the bytes of a glTF, or the parts of a vertex
 * sequence; `strain`: its block file, null where there is none. `onProgress` hears the share of a glTF that is here.
 */
export function downloadFigure(viewer, signal, onProgress = () => {}) {
  const model = viewer.kind === 'gltf' ? download(viewer.model, signal, onProgress) : vertexSequence(viewer.model);
  model.catch(() => {}); // said by who waits for it
  return { model, strain: viewer.strain ? strainFile(viewer.strain) : null };
}

async function download(url, signal, onProgress) {
  const answer = await fetch(url, { signal });
  if (!answer.ok) throw new Error(`${url} answered ${answer.status}`);
  const length = Number(answer.headers.get('Content-Length'));
  if (!length || answer.headers.has('Content-Encoding')) return answer.arrayBuffer(); // how much it will be is not known
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
    file.fetch(0).catch(() => {}); // asked for again when it is shown
    return file;
  } catch { return null; } // the figure is worth more than its colours
}
