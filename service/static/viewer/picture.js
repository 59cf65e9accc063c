// A picture filled by the processor, that hangs in the scene in front of all else.

import { BufferAttribute, BufferGeometry, DataTexture, GLSL3, Mesh, RawShaderMaterial, Vector2, Vector4 } from 'three';

const TILE = 64; // pixels: it grows and shrinks by so many at a time
const SPARE = 3; // times as large as it must be, it shrinks
const FARTHEST = 1;

const VERTEX = `
in vec3 position;
uniform vec4 place;
void main() { gl_Position = vec4(mix(place.xy, place.zw, position.xy), -1.0, 1.0); }`;
const FRAGMENT = `
precision highp float;
uniform sampler2D pixels;
uniform vec2 corner;
out vec4 colour;
void main() {
  colour = texelFetch(pixels, ivec2(gl_FragCoord.xy - corner), 0);
  if (colour.a == 0.0) discard;
}`;

export class Picture {
  #texture = null;

  constructor() {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]), 3)).setIndex([0, 1, 2, 0, 2, 3]);
    this.uniforms = { pixels: { value: null }, corner: { value: new Vector2() }, place: { value: new Vector4() } };
    const material = new RawShaderMaterial({ uniforms: this.uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT, glslVersion: GLSL3 });
    this.mesh = new Mesh(geometry, material);
    this.mesh.frustumCulled = false;
    this.width = this.height = this.left = this.low = 0;
  }

  /**
   * Empty it, and have it cover the pixels of `viewport` from `left` and `low` to before `right` and `high`. `colours` (red,
   * green, blue and alpha as bytes of one number) and `depths` hold its pixels row by row, the lowest first, `width` each.
   */
  begin({ left, right, low, high }, viewport) {
    this.mesh.visible = right > left && high > low;
    if (!this.mesh.visible) return;
    this.#fit(right - left, high - low);
    const pixels = this.width * (high - low);
    this.colours.fill(0, 0, pixels);
    this.depths.fill(FARTHEST, 0, pixels);
    this.left = left;
    this.low = low;
    const { x, y, z: width, w: height } = viewport;
    this.uniforms.corner.value.set(x + left, y + low);
    this.uniforms.place.value.set(left / width, low / height, right / width, high / height).multiplyScalar(2).subScalar(1);
    this.#texture.needsUpdate = true;
  }

  #fit(width, height) {
    const enough = width <= this.width && height <= this.height;
    if (enough && this.width * this.height <= SPARE * (width + TILE) * (height + TILE)) return;
    this.width = Math.ceil(width / TILE) * TILE;
    this.height = Math.ceil(height / TILE) * TILE;
    this.colours = new Uint32Array(this.width * this.height);
    this.depths = new Float32Array(this.colours.length);
    this.#texture?.dispose();
    this.#texture = new DataTexture(new Uint8Array(this.colours.buffer), this.width, this.height);
    this.uniforms.pixels.value = this.#texture;
  }
}
