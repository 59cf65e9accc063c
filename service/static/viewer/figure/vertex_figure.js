// The figure of a vertex sequence: blocks of int16 positions. The normals are computed here, frame by frame.

import { Box3, BufferAttribute, BufferGeometry, Group, Mesh, Vector3 } from 'three';
import { surfaceMaterial } from './materials.js';
import { orderTriangles } from './triangle_order.js';

const LARGEST = 32767;

/** The figure of the files of a vertex sequence. */
export const createVertexFigure = (viewer, { file, triangles, patches }, shading) =>
  new VertexFigure(file, orderTriangles(triangles), patches, shading);

class VertexFigure {
  #file; #triangles; #positions; #normals; #frame = -1; #sums;

  constructor(file, triangles, patches, shading) {
    this.#file = file;
    this.#triangles = triangles;
    const { vertices, half, centre } = file.header;
    this.#positions = new BufferAttribute(new Int16Array(vertices * 3), 3, true);
    this.#normals = new BufferAttribute(new Int8Array(vertices * 3), 3, true);
    this.#sums = new Float32Array(vertices * 3);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', this.#positions);
    geometry.setAttribute('normal', this.#normals);
    geometry.setAttribute('_patch', new BufferAttribute(Float32Array.from(patches), 1));
    geometry.setIndex(new BufferAttribute(triangles, 1));
    const mesh = new Mesh(geometry, shading.shade(surfaceMaterial(null, geometry)));
    mesh.frustumCulled = false;
    mesh.scale.setScalar(half);
    mesh.position.fromArray(centre);
    this.mesh = mesh;
    this.meshes = [mesh];
    this.object = new Group().add(mesh);
    this.pose(0);
  }

  ready(frame) {
    if (this.#file.has(frame)) return true;
    this.fetch(frame).catch(() => {});
    return false;
  }

  fetch(frame) { return this.#file.fetch(frame); }

  pose(position) {
    const frame = Math.floor(position);
    const values = frame === this.#frame ? null : this.#file.peek(frame);
    if (values) {
      this.#frame = frame;
      this.#positions.array.set(values);
      this.#positions.needsUpdate = true;
      this.#updateNormals(values);
      this.#file.prefetch(frame);
    }
    this.object.updateMatrixWorld(true);
  }

  /** Normals: the sum of the triangles' around each vertex, weighted by area. */
  #updateNormals(p) {
    const sums = this.#sums.fill(0);
    const t = this.#triangles;
    for (let i = 0; i < t.length; i += 3) {
      const a = 3 * t[i], b = 3 * t[i + 1], c = 3 * t[i + 2];
      const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
      const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
      const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
      sums[a] += x; sums[a + 1] += y; sums[a + 2] += z;
      sums[b] += x; sums[b + 1] += y; sums[b + 2] += z;
      sums[c] += x; sums[c + 1] += y; sums[c + 2] += z;
    }
    const normals = this.#normals.array;
    for (let i = 0; i < sums.length; i += 3) {
      const scale = 127 / (Math.hypot(sums[i], sums[i + 1], sums[i + 2]) || 1);
      normals[i] = sums[i] * scale;
      normals[i + 1] = sums[i + 1] * scale;
      normals[i + 2] = sums[i + 2] * scale;
    }
    this.#normals.needsUpdate = true;
  }

  /** The middle of the body, from a few hundred of its vertices. */
  centre(out) {
    const p = this.#positions.array;
    const step = this.#step;
    let n = 0;
    out.set(0, 0, 0);
    for (let i = 0; i < p.length; i += step) { out.x += p[i]; out.y += p[i + 1]; out.z += p[i + 2]; n += 1; }
    return out.divideScalar(n * LARGEST).applyMatrix4(this.mesh.matrixWorld);
  }

  get #step() { return 3 * Math.max(1, Math.floor(this.#positions.count / 500)); }

  /** Places of the body: x, y, z of each of the same vertices. */
  places() {
    const at = new Vector3();
    const found = [];
    for (let i = 0; i < this.#positions.count; i += this.#step / 3) {
      found.push(...at.fromBufferAttribute(this.#positions, i).applyMatrix4(this.mesh.matrixWorld).toArray());
    }
    return found;
  }

  box() {
    const box = new Box3();
    const at = new Vector3();
    for (let i = 0; i < this.#positions.count; i++) box.expandByPoint(at.fromBufferAttribute(this.#positions, i));
    return box.applyMatrix4(this.mesh.matrixWorld);
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
