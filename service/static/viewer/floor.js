// The floor: a grid that fades into the distance and a soft shade where the figure stands, in one plane.

import { Color, Mesh, PlaneGeometry, ShaderMaterial, Vector2 } from 'three';

const VERTEX = `
varying vec2 vAt;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vAt = world.xz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;
const FRAGMENT = `
uniform float cell, reach, body;
uniform vec2 middle, stand;
uniform vec3 line, shade;
varying vec2 vAt;
float grid(float size) {
  vec2 at = vAt / size;
  vec2 near = abs(fract(at - 0.5) - 0.5) / max(fwidth(at), 1e-6);
  return 1.0 - min(min(near.x, near.y), 1.0);
}
void main() {
  float fade = 1.0 - smoothstep(0.15, 1.0, length(vAt - middle) / reach);
  float lines = max(grid(cell) * 0.35, grid(cell * 5.0) * 0.7) * fade;
  float dark = 0.42 * exp(-3.2 * dot(vAt - stand, vAt - stand) / (body * body));
  float alpha = lines + dark * (1.0 - lines);
  gl_FragColor = vec4(mix(shade, line, alpha > 0.0 ? lines / alpha : 0.0), alpha);
  #include <colorspace_fragment>
}`;

export class Floor {
  constructor() {
    this.uniforms = {
      cell: { value: 1 }, reach: { value: 10 }, body: { value: 1 }, middle: { value: new Vector2() },
      stand: { value: new Vector2() }, line: { value: new Color() }, shade: { value: new Color() },
    };
    const material = new ShaderMaterial({
      uniforms: this.uniforms, vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false,
    });
    this.object = new Mesh(new PlaneGeometry(1, 1).rotateX(-Math.PI / 2), material);
    this.object.renderOrder = -1;
    this.object.frustumCulled = false;
  }

  /** Fit a figure of this height and width, standing at height `y`. Cells are 1, 2 or 5 times a power of ten. */
  fit(size, width, y) {
    const power = 10 ** Math.floor(Math.log10(size / 4));
    const steps = [5, 2, 1].map((n) => n * power);
    this.uniforms.cell.value = steps.find((step) => step <= size / 4) || power;
    this.uniforms.reach.value = size * 7;
    this.uniforms.body.value = Math.max(width * 0.75, size * 0.15);
    this.object.scale.setScalar(size * 15);
    this.object.position.y = y;
  }

  /** Keep under the figure; the lines stay where they are in the world. */
  follow(middle, stand) {
    this.object.position.x = middle.x;
    this.object.position.z = middle.z;
    this.uniforms.middle.value.set(middle.x, middle.z);
    this.uniforms.stand.value.set(stand.x, stand.z);
  }

  colours(line, shade) {
    this.uniforms.line.value.set(line);
    this.uniforms.shade.value.set(shade);
  }
}
