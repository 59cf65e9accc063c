// Streams of every codec, version and filter, by the encoder of meshoptimizer, and what its own decoder makes of them.
import { MeshoptDecoder, MeshoptEncoder } from "meshoptimizer";

await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
let seed = 7;
const random = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648;
const text = (bytes) => Buffer.from(bytes).toString("base64");

function report(encoded, count, size, mode, filter = "NONE") {
  const decoded = new Uint8Array(count * size);
  MeshoptDecoder.decodeGltfBuffer(decoded, count, size, encoded, mode, filter);
  console.log(JSON.stringify({ mode, filter, count, stride: size, encoded: text(encoded), decoded: text(decoded) }));
}

const NUMBERS = [Uint8Array, Uint16Array, Uint32Array, Float32Array];
for (const version of [0, 1])
  for (const level of [0, 1, 2, 3])
    for (const Numbers of NUMBERS)
      for (const [count, size] of [[1, 4], [15, 8], [16, 12], [17, 16], [200, 64], [257, 4], [600, 20], [70, 256]]) {
        const values = new Numbers((count * size) / Numbers.BYTES_PER_ELEMENT);
        const smooth = random() < 0.7, width = size / Numbers.BYTES_PER_ELEMENT;
        values.forEach((_, i) => {
          const row = Math.floor(i / width);
          values[i] = smooth ? 9000 + (i % width) * 100 + 40 * Math.sin(row / 9) + random() * (i % 7) : random() * 4e9;
        });
        report(MeshoptEncoder.encodeVertexBufferLevel(new Uint8Array(values.buffer), count, size, level, version),
          count, size, "ATTRIBUTES");
      }

const unit = (width, count) => Float32Array.from({ length: count * width }, () => random() * 2 - 1).map((x, i, all) => {
  const row = all.subarray(i - (i % width), i - (i % width) + width);
  return x / Math.hypot(...row);
});
for (const version of [0, 1]) {
  const encode = (data, size) => MeshoptEncoder.encodeVertexBufferLevel(data, 300, size, 2, version);
  for (const [size, bits] of [[4, 8], [4, 6], [8, 12], [8, 16]])
    report(encode(MeshoptEncoder.encodeFilterOct(unit(4, 300), 300, size, bits), size), 300, size, "ATTRIBUTES", "OCTAHEDRAL");
  for (const bits of [6, 12, 16])
    report(encode(MeshoptEncoder.encodeFilterQuat(unit(4, 300), 300, 8, bits), 8), 300, 8, "ATTRIBUTES", "QUATERNION");
  for (const bits of [8, 15, 23])
    report(encode(MeshoptEncoder.encodeFilterExp(unit(3, 300), 300, 12, bits), 12), 300, 12, "ATTRIBUTES", "EXPONENTIAL");
}

for (const side of [2, 5, 40, 300]) {
  const corners = [];
  for (let y = 0; y + 1 < side; y++)
    for (let x = 0; x + 1 < side && corners.length < 6000; x++) {
      const a = y * side + x;
      corners.push(a, a + 1, a + side, a + side, a + 1, a + side + 1);
    }
  const plain = Uint32Array.from(corners), shuffled = Uint32Array.from(corners, () => Math.floor(random() * side * side));
  const ordered = Uint32Array.from(corners);
  MeshoptEncoder.reorderMesh(ordered, true, true);
  for (const indices of [plain, shuffled, ordered])
    for (const size of side < 256 ? [2, 4] : [4]) {
      const bytes = new Uint8Array((size === 2 ? Uint16Array.from(indices) : indices).buffer);
      report(MeshoptEncoder.encodeIndexBuffer(bytes, indices.length, size), indices.length, size, "TRIANGLES");
      report(MeshoptEncoder.encodeIndexSequence(bytes, indices.length, size), indices.length, size, "INDICES");
    }
}
