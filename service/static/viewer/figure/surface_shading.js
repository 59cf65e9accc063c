// The shading of a surface: the model's own colours; over them the strain, or the colour of a motion; and an edge that stands
// out from the ground. Strain is one byte for each patch and frame. The shader looks it up, so a frame costs a few hundred bytes.

import { Color, DataTexture, NearestFilter, RedFormat, UnsignedByteType } from 'three';

// At rest the body's own clay, then through amber and vermilion to a dark violet: lightness falls all the way, so that the
// order is read without telling hues apart.
const HEAT = ['#d5d2ca', '#f0c15a', '#e8712e', '#ae1f57', '#43106b'];
const BEND = 0.7; // colour moves with strain to this power: most of a body is strained a little, and a little should be seen
const COVER = 0.72; // how much of its own colour a motion's colour hides
const GREYED = 0.55; // how much of its hue a surface loses under strain, so that hue tells strain alone

/** The colour of a body that has none of its own. */
export const CLAY = new Color(HEAT[0]);

const VERTEX = `
attribute float _patch;
uniform sampler2D strainMap;
uniform float patches;
varying float vStrain;
`;
const FRAGMENT = `
uniform vec3 heat[5];
uniform vec3 tint;
uniform float cover;
uniform float heated;
uniform vec3 rim;
uniform float shade;
varying float vStrain;
vec3 heatOf(float x) {
  vec3 c = mix(heat[0], heat[1], clamp(x, 0.0, 1.0));
  c = mix(c, heat[2], clamp(x - 1.0, 0.0, 1.0));
  c = mix(c, heat[3], clamp(x - 2.0, 0.0, 1.0));
  return mix(c, heat[4], clamp(x - 3.0, 0.0, 1.0));
}
vec3 covered(vec3 own) {
  if (heated < 0.5) return mix(own, tint, cover);
  float x = pow(clamp(vStrain, 0.0, 1.0), ${BEND}) * 4.0;
  vec3 grey = mix(own, vec3(dot(own, vec3(0.2126, 0.7152, 0.0722))), ${GREYED});
  return mix(grey, heatOf(x), smoothstep(0.0, 1.2, x));
}
`;
const COLOUR = 'diffuseColor.rgb = covered(diffuseColor.rgb);';
const EDGE = `
  float edge = 1.0 - clamp(dot(normal, normalize(vViewPosition)), 0.0, 1.0);
  edge *= edge * edge;
  diffuseColor.rgb *= 1.0 - shade * edge;
  totalEmissiveRadiance += rim * edge;
`;
const TURN = '#ifdef MIRRORED\n  normal = -normal;\n#endif';

const after = (source, chunk, more) => source.replace(`#include <${chunk}>`, `#include <${chunk}>\n  ${more}`);

/** How the edge of a figure stands out: from a dark ground by light, from a light one by shade. Shared by all figures. */
const edge = { rim: { value: new Color(0) }, shade: { value: 0 } };

export function setEdge(rim, shade) {
  edge.rim.value.set(rim);
  edge.shade.value = shade;
}

export class SurfaceShading {
  #file; #shown = -1;

  /** The shading of a block file of strain, or of none. */
  constructor(file = null) {
    this.#file = file;
    this.uniforms = {
      strainMap: { value: null },
      patches: { value: 1 },
      heat: { value: HEAT.map((hex) => new Color(hex)) },
      tint: { value: CLAY.clone() },
      cover: { value: 0 },
      heated: { value: 0 },
      ...edge,
    };
    this.#texture(file ? file.header.patches : 1);
  }

  get present() { return this.#file !== null; }

  /** The colours from rest to the most strain, for the legend. */
  get gradient() { return `linear-gradient(to right, ${HEAT.join(', ')})`; }

  #texture(patches) {
    const map = new DataTexture(new Uint8Array(patches), patches, 1, RedFormat, UnsignedByteType);
    map.magFilter = map.minFilter = NearestFilter;
    map.unpackAlignment = 1;
    this.uniforms.strainMap.value = map;
    this.uniforms.patches.value = patches;
  }

  /** Shade a material; with MIRRORED among its `defines`, the light falls on the other side. */
  shade(material) {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = VERTEX + after(shader.vertexShader, 'begin_vertex',
        'vStrain = texture2D(strainMap, vec2((_patch + 0.5) / patches, 0.5)).r;');
      const coloured = after(FRAGMENT + shader.fragmentShader, 'color_fragment', COLOUR);
      shader.fragmentShader = after(after(coloured, 'normal_fragment_maps', TURN), 'emissivemap_fragment', EDGE);
    };
    return material;
  }

  /** Whether a frame can be shown without waiting. */
  ready(frame) { return !this.#file || this.#file.has(frame); }

  /** Show the strain of a frame; until its block is fetched the one before stays. */
  showFrame(frame) {
    if (!this.#file || !this.uniforms.heated.value || frame === this.#shown) return;
    const values = this.#file.peek(frame);
    if (!values) return;
    this.#shown = frame;
    const map = this.uniforms.strainMap.value;
    map.image.data.set(values);
    map.needsUpdate = true;
    this.#file.prefetch(frame);
  }

  fetch(frame) { return this.#file ? this.#file.fetch(frame) : Promise.resolve(); }

  /** Colour by `strain`, by the colour of a motion, or by null as the model is. */
  colourBy(choice) {
    const heated = choice === 'strain' && this.present;
    this.uniforms.heated.value = heated ? 1 : 0;
    this.uniforms.cover.value = choice && choice !== 'strain' ? COVER : 0;
    if (this.uniforms.cover.value) this.uniforms.tint.value.set(choice);
  }

  dispose() { this.uniforms.strainMap.value.dispose(); }
}
