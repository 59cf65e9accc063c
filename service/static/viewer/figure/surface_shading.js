// Strain as colour: one byte for each patch and frame. The shader looks it up, so a frame costs a few hundred bytes.

import { Color, DataTexture, NearestFilter, RedFormat, UnsignedByteType } from 'three';

// At rest the body's own clay, then through amber and vermilion to a dark violet: lightness falls all the way, so that the
// order is read without telling hues apart.
const HEAT = ['#d5d2ca', '#f0c15a', '#e8712e', '#ae1f57', '#43106b'];
const BEND = 0.7; // colour moves with strain to this power: most of a body is strained a little, and a little should be seen
const CLAY = new Color(HEAT[0]);

const VERTEX = `
attribute float _patch;
uniform sampler2D strainMap;
uniform float patches;
varying float vStrain;
`;
const FRAGMENT = `
#define BEND ${BEND}
uniform vec3 heat[5];
uniform vec3 tint;
uniform float heated;
varying float vStrain;
vec3 heatOf(float s) {
  float x = pow(clamp(s, 0.0, 1.0), BEND) * 4.0;
  vec3 c = mix(heat[0], heat[1], clamp(x, 0.0, 1.0));
  c = mix(c, heat[2], clamp(x - 1.0, 0.0, 1.0));
  c = mix(c, heat[3], clamp(x - 2.0, 0.0, 1.0));
  return mix(c, heat[4], clamp(x - 3.0, 0.0, 1.0));
}
`;

export class StrainShading {
  #file; #shown = -1;

  /** The shading of a block file of strain, or of none. */
  constructor(file = null) {
    this.#file = file;
    this.uniforms = {
      strainMap: { value: null },
      patches: { value: 1 },
      heat: { value: HEAT.map((hex) => new Color(hex)) },
      tint: { value: CLAY.clone() },
      heated: { value: 0 },
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

  /** Make a material show strain or a tint; with MIRRORED among its `defines`, the light falls on the other side. */
  shade(material) {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.uniforms);
      shader.vertexShader = VERTEX + shader.vertexShader.replace('#include <begin_vertex>',
        '#include <begin_vertex>\n  vStrain = texture2D(strainMap, vec2((_patch + 0.5) / patches, 0.5)).r;');
      shader.fragmentShader = FRAGMENT + shader.fragmentShader
        .replace('#include <color_fragment>', '#include <color_fragment>\n  diffuseColor.rgb = mix(tint, heatOf(vStrain), heated);')
        .replace('#include <normal_fragment_maps>', '#include <normal_fragment_maps>\n#ifdef MIRRORED\n  normal = -normal;\n#endif');
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

  /** Colour by `strain`, by one colour for the whole body, or by null as clay. */
  colourBy(choice) {
    const heated = choice === 'strain' && this.present;
    this.uniforms.heated.value = heated ? 1 : 0;
    if (!heated) this.uniforms.tint.value.copy(choice && choice !== 'strain' ? new Color(choice).lerp(CLAY, 0.15) : CLAY);
  }

  dispose() { this.uniforms.strainMap.value.dispose(); }
}
