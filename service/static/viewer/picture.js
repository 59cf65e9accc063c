// A picture filled by the processor, with the depth of each pixel, that hangs in the scene as if it had been drawn there.

import { BufferAttribute, BufferGeometry, DataTexture, GLSL3, Mesh, RGIntegerFormat, RawShaderMaterial, UnsignedIntType, Vector2, Vector4 } from 'three';

const TILE = 64; // pixels: it grows and shrinks by so many at a time
const SPARE = 3; // times as large as it must be, it shrinks
const EMPTY = 0x3f80000000000000n; // colour 0 and depth 1, as they lie in memory

const VERTEX = `
in vec3 position;
uniform vec4 place;
void main() { gl_Position = vec4(mix(place.xy, place.zw, position.xy), 0.0, 1.0); }`;
const FRAGMENT = `
precision highp float;
precision highp usampler2D;
uniform usampler2D pixels;
uniform vec2 corner;
out vec4 colour;
void main() {
  uvec2 pixel = texelFetch(pixels, ivec2(gl_FragCoord.xy - corner), 0).rg;
  if (pixel.r == 0u) discard;
  colour = vec4((uvec4(pixel.r) >> uvec4(0, 8, 16, 24)) & 255u) / 255.0;
  gl_FragDepth = uintBitsToFloat(pixel.g);
}`;

export class Picture {
  #texture = null; #words;

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
   * Empty it, and have it cover the pixels of `viewport` from `left` and `low` to before `right` and `high`. Of each pixel
   * `colours` (red, green, blue and alpha as bytes of one number) and `depths` hold every second number, row by row, the
   * lowest first, `width` pixels each.
   */
  begin({ left, right, low, high }, viewport) {
    this.mesh.visible = right > left && high > low;
    if (!this.mesh.visible) return;
    this.#fit(right - left, high - low);
    this.#words.fill(EMPTY, 0, this.width * (high - low));
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
    this.colours = new Uint32Array(2 * this.width * this.height);
    this.depths = new Float32Array(this.colours.buffer);
    this.#words = new BigUint64Array(this.colours.buffer);
    this.#texture?.dispose();
    // Colour and depth side by side: one texture is sent, and one fetched from.
    this.#texture = new DataTexture(this.colours, this.width, this.height, RGIntegerFormat, UnsignedIntType);
    this.#texture.internalFormat = 'RG32UI';
    this.uniforms.pixels.value = this.#texture;
  }
}
