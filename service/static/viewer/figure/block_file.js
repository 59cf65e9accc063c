// A block file read by Range (formats/playback/block_file.py says how it is laid out).

const FIRST_BYTES = 65536;
const KEPT_BYTES = 96 * 2 ** 20;
const TYPES = { uint32: Uint32Array, uint16: Uint16Array, int16: Int16Array, uint8: Uint8Array };
const MAGIC = 'CAESURA\x01';

async function range(url, start, stop, cache = 'default') {
  const answer = await fetch(url, { headers: { Range: `bytes=${start}-${stop - 1}` }, cache });
  if (!answer.ok) throw new Error(`${url} answered ${answer.status}`);
  const bytes = await answer.arrayBuffer();
  if (answer.status !== 206) return bytes.slice(start, stop); // 200: a proxy that knows no Range sent it all
  const length = Number(answer.headers.get('Content-Length') ?? bytes.byteLength);
  if (bytes.byteLength >= length) return bytes;
  if (cache === 'reload') throw new Error(`${url} broke off`);
  return range(url, start, stop, 'reload'); // Chromium's cache answers ranges that two readers asked for with no bytes at times
}

export class BlockFile {
  #url; #first; #type; #blocks = new Map(); #pending = new Map();

  static async open(url, type) {
    const file = new BlockFile();
    file.#url = url;
    file.#type = TYPES[type];
    file.#first = await range(url, 0, FIRST_BYTES);
    const text = new TextDecoder();
    if (text.decode(file.#first.slice(0, 8)) !== MAGIC) throw new Error(`${url} is no block file of version 1`);
    const length = new DataView(file.#first).getUint32(8, true);
    file.header = JSON.parse(text.decode(file.#first.slice(12, 12 + length)));
    file.perBlock = file.header.blocks.frames_per_block;
    return file;
  }

  /** One of the static arrays. */
  async array(name) {
    const { type, shape, offset } = this.header.arrays[name];
    const Type = TYPES[type];
    const count = shape.reduce((a, b) => a * b, 1);
    const stop = offset + count * Type.BYTES_PER_ELEMENT;
    return new Type(stop <= this.#first.byteLength ? this.#first.slice(offset, stop) : await range(this.#url, offset, stop));
  }

  /** The values of a frame if its block is fetched; else undefined, and the block is fetched. */
  peek(frame) {
    const index = Math.floor(frame / this.perBlock);
    const block = this.#blocks.get(index);
    if (!block) { this.fetch(frame).catch(() => {}); return undefined; }
    const size = this.header.blocks.frame_bytes / this.#type.BYTES_PER_ELEMENT;
    const within = frame - index * this.perBlock;
    return block.subarray(within * size, (within + 1) * size);
  }

  /** Fetch the block after the one of `frame`, so that playback does not wait for it. */
  prefetch(frame) {
    const next = frame + this.perBlock;
    if (next < this.header.frames && !this.has(next)) this.fetch(next).catch(() => {});
  }

  has(frame) { return this.#blocks.has(Math.floor(frame / this.perBlock)); }

  /** Fetch the block of a frame; several calls make one request. */
  fetch(frame) {
    const index = Math.floor(frame / this.perBlock);
    if (this.#blocks.has(index)) return Promise.resolve();
    if (!this.#pending.has(index)) this.#pending.set(index, this.#load(index).finally(() => this.#pending.delete(index)));
    return this.#pending.get(index);
  }

  async #load(index) {
    const { offset, frame_bytes: bytes } = this.header.blocks;
    const start = index * this.perBlock;
    const stop = Math.min(start + this.perBlock, this.header.frames);
    const data = await range(this.#url, offset + start * bytes, offset + stop * bytes);
    this.#blocks.set(index, new this.#type(data));
    const most = Math.max(4, Math.floor(KEPT_BYTES / (bytes * this.perBlock)));
    for (const oldest of this.#blocks.keys()) {
      if (this.#blocks.size <= most) break;
      this.#blocks.delete(oldest);
    }
  }
}
