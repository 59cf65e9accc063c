// The floor: lines that fade into the distance, and a soft shade where the figure stands. It is lines and one small square
// and no plane to the horizon, because software WebGL pays for every pixel that is covered.

import { BufferAttribute, BufferGeometry, Color, Group, LineSegments, Mesh, PlaneGeometry, ShaderMaterial, Vector2 } from 'three';

const REACH = 25; // cells from the middle to where nothing is left of the strong lines
const NEAR = 0.55; // of that, of the others
const COARSE = 5; // every fifth line is stronger, and seen further
const PIECE = 4; // cells: a line is cut into such, for it fades along its length
const SLACK = (COARSE / 2) * Math.SQRT2; // cells: the lines lag so far behind the middle
const BLOB = 1.2; // bodies' widths from the middle of the shade to where nothing of it is left

const LINES = {
  vertexShader: `
attribute float strength;
uniform float reach;
uniform vec2 middle;
varying float vAlpha;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vAlpha = strength * (1.0 - smoothstep(0.1, strength > 0.5 ? 1.0 : ${NEAR}, length(world.xz - middle) / reach));
  gl_Position = projectionMatrix * viewMatrix * world;
}`,
  fragmentShader: `
uniform vec3 line;
varying float vAlpha;
void main() {
  gl_FragColor = vec4(line, vAlpha);
  #include <colorspace_fragment>
}`,
};
const SHADE = {
  vertexShader: `
varying vec2 vAt;
void main() {
  vAt = position.xz * 2.0;
  gl_Position = projectionMatrix * viewMatrix * modelMatrix * vec4(position, 1.0);
}`,
  fragmentShader: `
uniform vec3 shade;
varying vec2 vAt;
void main() {
  float left = max(0.0, 1.0 - dot(vAt, vAt));
  gl_FragColor = vec4(shade, 0.42 * left * left * left);
  #include <colorspace_fragment>
}`,
};

export class Floor {
  #lines; #shade; #cell = 1;

  constructor() {
    this.uniforms = { reach: { value: 10 }, middle: { value: new Vector2() }, line: { value: new Color() }, shade: { value: new Color() } };
    const material = (shaders) => new ShaderMaterial({ uniforms: this.uniforms, ...shaders, transparent: true, depthWrite: false });
    this.#lines = new LineSegments(grid(), material(LINES));
    this.#shade = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), material(SHADE));
    this.#shade.renderOrder = -2;
    this.#lines.renderOrder = -1;
    this.#lines.frustumCulled = this.#shade.frustumCulled = false;
    this.object = new Group().add(this.#shade, this.#lines);
  }

  /** Fit a figure of this height and width, standing at height `y`. Cells are 1, 2 or 5 times a power of ten. */
  fit(size, width, y) {
    const power = 10 ** Math.floor(Math.log10(size / 4));
    const steps = [5, 2, 1].map((n) => n * power);
    this.#cell = steps.find((step) => step <= size / 4) || power;
    this.uniforms.reach.value = this.#cell * REACH;
    this.#lines.scale.setScalar(this.#cell);
    this.#shade.scale.setScalar(2 * BLOB * Math.max(width * 0.75, size * 0.15));
    this.object.position.y = y;
  }

  /** Keep under the figure; the lines stay where they are in the world. */
  follow(middle, stand) {
    const step = this.#cell * COARSE;
    this.#lines.position.set(Math.round(middle.x / step) * step, 0, Math.round(middle.z / step) * step);
    this.#shade.position.set(stand.x, 0, stand.z);
    this.uniforms.middle.value.set(middle.x, middle.z);
  }

  setColours(line, shade) {
    this.uniforms.line.value.set(line);
    this.uniforms.shade.value.set(shade);
  }
}

/** Lines both ways, a cell of 1 apart, as far as they can be seen, in pieces. */
function grid() {
  const places = [];
  const strengths = [];
  const farthest = Math.floor(REACH + SLACK);
  for (let at = -farthest; at <= farthest; at++) {
    const strong = at % COARSE === 0;
    const half = Math.sqrt((REACH * (strong ? 1 : NEAR) + SLACK) ** 2 - at * at) || 0; // of the chord in the circle that is seen
    const pieces = Math.ceil((2 * half) / PIECE);
    for (let piece = 0; piece < pieces; piece++) {
      const [from, to] = [piece, piece + 1].map((end) => half * (2 * end / pieces - 1));
      places.push(at, 0, from, at, 0, to, from, 0, at, to, 0, at);
      strengths.push(...Array(4).fill(strong ? 0.7 : 0.35));
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(places), 3));
  geometry.setAttribute('strength', new BufferAttribute(new Float32Array(strengths), 1));
  return geometry;
}
