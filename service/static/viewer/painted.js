// A surface for a machine without a graphics card. There a vertex costs as much as its shader is long and a triangle costs
// even where it is turned away: so each vertex is lit and coloured here, by the same equations as MeshLambertMaterial, and
// of a closed surface only the triangles that face the eye are drawn. What is left to the renderer is to fill them.

import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, RawShaderMaterial, Vector3 } from 'three';
import { facing } from './closed.js';

const SHADES = 4095;
/** The byte of sRGB for a linear value of 0 to SHADES. */
const BYTES = Uint8Array.from({ length: SHADES + 1 }, (_, i) => Math.round(255 * new Color().setScalar(i / SHADES).convertLinearToSRGB().r));
const VERTEX = `
attribute vec3 position;
attribute vec4 shade;
uniform mat4 modelViewMatrix, projectionMatrix;
varying lowp vec4 vShade;
void main() {
  vShade = shade;
  gl_Position = projectionMatrix * (modelViewMatrix * vec4(position, 1.0));
}`;
const FRAGMENT = `
precision lowp float;
varying vec4 vShade;
void main() { gl_FragColor = vShade; }`;

export class Painted {
  #positions; #normals; #triangles; #patches; #strain; #shades; #front; #facing = null; #eye = new Vector3();

  /** `positions`: an attribute; `normals`: flat, of any length each; both change from frame to frame. `patches`: of each vertex. */
  constructor(positions, normals, triangles, patches, strain) {
    const material = new RawShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.#positions = positions;
    this.#normals = normals;
    this.#triangles = triangles;
    this.#patches = Uint16Array.from(patches);
    this.#strain = strain;
    this.#shades = new BufferAttribute(new Uint8Array(4 * positions.count).fill(255), 4, true);
    this.#front = new BufferAttribute(new triangles.constructor(triangles), 1);
    const { geometry } = this.mesh;
    geometry.setAttribute('position', positions).setAttribute('shade', this.#shades).setIndex(this.#front);
    this.mesh.frustumCulled = false;
  }

  /** Light, colour and choose what is seen from `camera` in the pose of now; `light` is what `Light.parts` says. */
  paint(camera, light) {
    this.#facing ??= facing(this.#positions.array, this.#triangles);
    const toOwn = this.mesh.matrixWorld.clone().invert();
    const own = (direction) => direction.clone().transformDirection(toOwn);
    const unit = this.#positions.normalized ? 32767 : 1; // int16 positions are worked with as they are stored
    this.#eye.setFromMatrixPosition(camera.matrixWorld).applyMatrix4(toOwn).multiplyScalar(unit);
    this.#shade(light, own(new Vector3(0, 1, 0)), own(light.keyFrom), own(light.rimFrom));
    if (this.#facing) this.#choose();
  }

  #shade({ ground, sky, key, rim }, up, k, r) {
    const [p, n, patches] = [this.#positions.array, this.#normals, this.#patches];
    const { colours, values } = this.#strain.painting();
    const { x: ex, y: ey, z: ez } = this.#eye;
    const open = !this.#facing;
    const sign = this.#facing || 1;
    const shades = this.#shades.array;
    for (let v = 0, i = 0; v < patches.length; v++, i += 3) {
      let [x, y, z] = [n[i], n[i + 1], n[i + 2]];
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
    this.#shades.needsUpdate = true;
  }

  /** Keep the triangles that face the eye. */
  #choose() {
    const [p, t, front] = [this.#positions.array, this.#triangles, this.#front.array];
    const { x: ex, y: ey, z: ez } = this.#eye;
    const sign = this.#facing;
    let kept = 0;
    for (let i = 0; i < t.length; i += 3) {
      const a = 3 * t[i], b = 3 * t[i + 1], c = 3 * t[i + 2];
      const x = p[a], y = p[a + 1], z = p[a + 2];
      const ux = p[b] - x, uy = p[b + 1] - y, uz = p[b + 2] - z;
      const vx = p[c] - x, vy = p[c + 1] - y, vz = p[c + 2] - z;
      const towards = (uy * vz - uz * vy) * (ex - x) + (uz * vx - ux * vz) * (ey - y) + (ux * vy - uy * vx) * (ez - z);
      if (towards * sign <= 0) continue;
      front[kept] = t[i]; front[kept + 1] = t[i + 1]; front[kept + 2] = t[i + 2];
      kept += 3;
    }
    this.mesh.geometry.setDrawRange(0, kept);
    this.#front.needsUpdate = true;
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}
