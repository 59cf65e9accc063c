// The light: a sky, a key light over the viewer's left shoulder, so that no side of the figure is dark, and a rim from behind.

import { DirectionalLight, Group, HemisphereLight } from 'three';

export class Light {
  #key = new DirectionalLight(0xfff4e6, 1.7); #rim = new DirectionalLight(0xcfe0ff, 0.9);
  #sky = new HemisphereLight(0xffffff, 0xb5aa9a, 1.9);

  constructor() {
    this.object = new Group().add(this.#sky, this.#key, this.#rim, this.#key.target, this.#rim.target);
  }

  /** Stand about `target` as the camera sees it. */
  follow(camera, target) {
    this.#key.position.set(-0.5, 0.9, 0.6).applyQuaternion(camera.quaternion).add(target);
    this.#rim.position.set(0.9, 0.5, -0.8).applyQuaternion(camera.quaternion).add(target);
    for (const light of [this.#key, this.#rim]) light.target.position.copy(target);
  }
}
