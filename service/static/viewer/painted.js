// A surface for a machine without a graphics card: posed, lit, coloured and filled here. The equations of its light are
// those of MeshLambertMaterial, so that it looks as it does with one.

import { Color, Matrix4, Vector3 } from 'three';
import { facing } from './closed.js';
import { fill } from './filling.js';

const SHADES = 4095;
/** The byte of sRGB for a linear value of 0 to SHADES. */
const BYTES = Uint8Array.from({ length: SHADES + 1 }, (_, i) => Math.round(255 * new Color().setScalar(i / SHADES).convertLinearToSRGB().r));

export class Painted {
  #positions; #normals; #triangles; #patches; #strain; #place; #shades; #at; #facing = null; #eye = new Vector3(); #toClip = new Matrix4();

  /**
   * `positions`: an attribute; `normals`: flat, of any length each; both change from frame to frame, and are where `place`
   * says. `patches`: of each vertex.
   */
  constructor(positions, normals, triangles, patches, strain, place) {
    this.#positions = positions;
    this.#normals = normals;
    this.#triangles = triangles;
    this.#patches = Uint16Array.from(patches);
    this.#strain = strain;
    this.#place = place;
    this.#shades = new Uint8Array(4 * positions.count);
    this.#at = new Float32Array(3 * positions.count);
  }

  /**
   * Light it and find where it is in a picture of `width` by `height` pixels, as `camera` sees it in the pose of now;
   * `light` is what `Light.parts` says, and `bounds` grows to hold it.
   */
  prepare(camera, light, width, height, bounds) {
    const { matrixWorld } = this.#place;
    this.#facing ??= facing(this.#positions.array, this.#triangles);
    const toOwn = matrixWorld.clone().invert();
    const own = (direction) => direction.clone().transformDirection(toOwn);
    const unit = this.#positions.normalized ? 32767 : 1; // int16 positions are worked with as they are stored
    this.#eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(toOwn).multiplyScalar(unit);
    this.#shade(light, own(new Vector3(0, 1, 0)), own(light.keyFrom), own(light.rimFrom));
    this.#toClip.multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse).multiply(matrixWorld);
    this.#toClip.scale(new Vector3().setScalar(1 / unit));
    this.#project(camera.near, width, height, bounds);
  }

  /** Fill what `prepare` found into a picture. */
  paint(picture) {
    const side = this.#facing * Math.sign(this.#place.matrixWorld.determinant());
    fill(picture, this.#at, this.#shades, this.#triangles, side);
  }

  #shade({ ground, sky, key, rim }, up, k, r) {
    const [p, n, patches] = [this.#positions.array, this.#normals, this.#patches];
    const { colours, values } = this.#strain.painting();
    const { x: ex, y: ey, z: ez } = this.#eye;
    const open = !this.#facing;
    const sign = this.#facing || 1;
    const shades = this.#shades;
    for (let v = 0, i = 0; v < patches.length; v++, i += 3) {
      let x = n[i], y = n[i + 1], z = n[i + 2];
      let scale = sign / (Math.sqrt(x * x + y * y + z * z) || 1);
      if (open && x * (ex - p[i]) + y * (ey - p[i + 1]) + z * (ez - p[i + 2]) < 0) scale = -scale; // lit on both sides
      x *= scale; y *= scale; z *= scale;
      const above = 0.5 + 0.5 * (x * up.x + y * up.y + z * up.z);
      const lit = Math.max(0, x * k.x + y * k.y + z * k.z);
      const edge = Math.max(0, x * r.x + y * r.y + z * r.z);
      const colour = values ? 3 * values[patches[v]] : 0;
      for (let c = 0; c < 3; c++) {
        const shine = ground[c] + above * (sky[c] - ground[c]) + lit * key[c] + edge * rim[c];
        shades[4 * v + c] = BYTES[Math.min(SHADES, colours[colour + c] * shine * SHADES | 0)];
      }
    }
  }

  /** Where each vertex is, in pixels, and how deep. What is behind the camera is nowhere. */
  #project(near, width, height, bounds) {
    const [p, at, m] = [this.#positions.array, this.#at, this.#toClip.elements];
    let { left, right, low, high } = bounds;
    for (let i = 0; i < p.length; i += 3) {
      const x = p[i], y = p[i + 1], z = p[i + 2];
      const w = m[3] * x + m[7] * y + m[11] * z + m[15];
      const scale = w > near ? 0.5 / w : NaN;
      const across = width * (0.5 + scale * (m[0] * x + m[4] * y + m[8] * z + m[12]));
      const up = height * (0.5 + scale * (m[1] * x + m[5] * y + m[9] * z + m[13]));
      at[i] = across; at[i + 1] = up;
      at[i + 2] = 0.5 + scale * (m[2] * x + m[6] * y + m[10] * z + m[14]);
      if (across < left) left = across;
      if (across > right) right = across;
      if (up < low) low = up;
      if (up > high) high = up;
    }
    Object.assign(bounds, { left, right, low, high });
  }
}
