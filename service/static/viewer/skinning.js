// A skinned mesh posed here instead of on the graphics card: what three.js does in its vertex shader, for a machine that
// has none.

import { BufferAttribute, Matrix4 } from 'three';

/** Poses one mesh: `pose()` fills `positions` (an attribute) and `normals` (flat, of any length), in the world. */
export class Skinning {
  #mesh; #joints; #weights; #rest; #restNormals; #matrices; #matrix = new Matrix4();

  constructor(mesh) {
    const { geometry, skeleton } = mesh;
    const flat = (name) => floats(geometry.getAttribute(name));
    this.#mesh = mesh;
    this.#rest = flat('position');
    this.#restNormals = flat('normal');
    this.#weights = flat('skinWeight');
    this.#joints = Uint16Array.from(flat('skinIndex'));
    this.#matrices = new Float32Array(16 * skeleton.bones.length);
    this.positions = new BufferAttribute(new Float32Array(this.#rest.length), 3);
    this.normals = new Float32Array(this.#rest.length);
  }

  /** Whether a mesh is one that can be posed here. */
  static suits({ isSkinnedMesh, geometry }) {
    return Boolean(isSkinnedMesh && geometry.index && geometry.getAttribute('normal') && !Object.keys(geometry.morphAttributes).length);
  }

  pose() {
    this.#bones();
    const [m, joints, weights, p, n] = [this.#matrices, this.#joints, this.#weights, this.#rest, this.#restNormals];
    const [positions, normals] = [this.positions.array, this.normals];
    for (let i = 0, j = 0; i < p.length; i += 3, j += 4) {
      let px = 0, py = 0, pz = 0, nx = 0, ny = 0, nz = 0;
      const x = p[i], y = p[i + 1], z = p[i + 2], u = n[i], v = n[i + 1], w = n[i + 2];
      for (let k = j; k < j + 4; k++) {
        const weight = weights[k];
        if (!weight) continue;
        const o = 16 * joints[k];
        px += weight * (m[o] * x + m[o + 4] * y + m[o + 8] * z + m[o + 12]);
        py += weight * (m[o + 1] * x + m[o + 5] * y + m[o + 9] * z + m[o + 13]);
        pz += weight * (m[o + 2] * x + m[o + 6] * y + m[o + 10] * z + m[o + 14]);
        nx += weight * (m[o] * u + m[o + 4] * v + m[o + 8] * w);
        ny += weight * (m[o + 1] * u + m[o + 5] * v + m[o + 9] * w);
        nz += weight * (m[o + 2] * u + m[o + 6] * v + m[o + 10] * w);
      }
      positions[i] = px; positions[i + 1] = py; positions[i + 2] = pz;
      normals[i] = nx; normals[i + 1] = ny; normals[i + 2] = nz;
    }
  }

  /** Every bone's way from the bind pose to where it is in the world. */
  #bones() {
    const { skeleton, bindMatrix, bindMatrixInverse, matrixWorld } = this.#mesh;
    const world = matrixWorld.clone().multiply(bindMatrixInverse);
    skeleton.bones.forEach((bone, index) => this.#matrix.multiplyMatrices(world, bone.matrixWorld)
      .multiply(skeleton.boneInverses[index]).multiply(bindMatrix).toArray(this.#matrices, 16 * index));
  }
}

/** The numbers of an attribute, however they are stored. */
function floats(attribute) {
  const out = new Float32Array(attribute.count * attribute.itemSize);
  for (let i = 0; i < attribute.count; i++) {
    for (let c = 0; c < attribute.itemSize; c++) out[i * attribute.itemSize + c] = attribute.getComponent(i, c);
  }
  return out;
}
