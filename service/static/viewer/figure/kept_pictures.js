// The pictures that are kept with a result: one sheet of them, eight in a row, and the one that stands for the result by itself.

import * as api from '../service/api.js';

const COLUMNS = 8;
const MOST = 96; // that are kept
const LARGEST = 120_000; // bytes of the sheet: the service takes JSON of 256 kB
const QUALITY = 0.85;

/** Pairs of a frame and its picture; null where none are kept. */
export async function keptPictures(id) {
  const kept = await api.pictures(id);
  if (!kept) return null;
  const { width, height, frames, sheet } = kept;
  const bytes = Uint8Array.from(atob(sheet), (letter) => letter.charCodeAt(0));
  const whole = await createImageBitmap(new Blob([bytes]));
  const pictures = await Promise.all(frames.map((_, i) => createImageBitmap(whole, ...placeOf(i, width, height), width, height)));
  whole.close();
  return frames.map((frame, i) => [frame, pictures[i]]);
}

/** Keep pictures, by their frames, with a result; that of frame `poster`, or else the first, stands for it. */
export async function keepDrawn(id, pictures, poster) {
  const drawn = [...pictures].slice(0, MOST);
  if (!drawn.length) return;
  const [[, { width, height }]] = drawn;
  const rows = Math.ceil(drawn.length / COLUMNS);
  const sheet = await packed(Math.min(drawn.length, COLUMNS) * width, rows * height, (context) => {
    drawn.forEach(([, picture], i) => context.drawImage(picture, ...placeOf(i, width, height), width, height));
  });
  const one = await packed(width, height, (context) => context.drawImage(pictures.get(poster) ?? drawn[0][1], 0, 0, width, height));
  if (sheet.length > LARGEST) return;
  await api.keepPictures(id, { width, height, frames: drawn.map(([frame]) => frame), sheet: base64(sheet), poster: base64(one) });
}

const placeOf = (i, width, height) => [(i % COLUMNS) * width, Math.floor(i / COLUMNS) * height];

/** The bytes of an image of this size: a WebP, or a PNG of browsers that write no WebP. */
async function packed(width, height, draw) {
  const canvas = Object.assign(document.createElement('canvas'), { width, height });
  draw(canvas.getContext('2d'));
  const blob = await new Promise((done) => canvas.toBlob(done, 'image/webp', QUALITY));
  return new Uint8Array(await blob.arrayBuffer());
}

const base64 = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
