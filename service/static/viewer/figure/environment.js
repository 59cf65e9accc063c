// What a shining material mirrors: a pale sky over a warm ground. Only where a graphics card draws; software would be slow.

import { BackSide, Mesh, PMREMGenerator, Scene, ShaderMaterial, SphereGeometry } from 'three';

const SKY = {
  vertexShader: `
varying float vUp;
void main() {
  vUp = normalize(position).y;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`,
  fragmentShader: `
varying float vUp;
void main() { gl_FragColor = vec4(mix(vec3(0.42, 0.38, 0.33), vec3(1.0, 1.02, 1.06), smoothstep(-0.25, 0.6, vUp)), 1.0); }`,
};

/** The texture for `Scene.environment`. */
export function skyEnvironment(renderer) {
  const sphere = new Mesh(new SphereGeometry(10, 32, 16), new ShaderMaterial({ ...SKY, side: BackSide }));
  const generator = new PMREMGenerator(renderer);
  const { texture } = generator.fromScene(new Scene().add(sphere), 0.02);
  generator.dispose();
  sphere.geometry.dispose();
  sphere.material.dispose();
  return texture;
}
