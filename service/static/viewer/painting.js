// The figure as the processor paints it: all its surfaces in one picture, which the renderer then only hangs up.

import { Vector4 } from 'three';
import { Picture } from './picture.js';

export class Painting {
  #picture = new Picture(); #viewport = new Vector4();

  get object() { return this.#picture.mesh; }

  /** Paint `surfaces` as `camera` and `renderer` are about to show them; `light` is what `Light.parts` says. */
  paint(surfaces, camera, light, renderer) {
    camera.updateMatrixWorld();
    const { z: width, w: height } = renderer.getCurrentViewport(this.#viewport);
    const seen = { left: width, right: 0, low: height, high: 0 };
    for (const surface of surfaces) surface.prepare(camera, light, width, height, seen);
    this.#picture.begin({
      left: Math.max(0, Math.floor(seen.left)), right: Math.min(width, Math.ceil(seen.right)),
      low: Math.max(0, Math.floor(seen.low)), high: Math.min(height, Math.ceil(seen.high)),
    }, this.#viewport);
    if (this.object.visible) for (const surface of surfaces) surface.paint(this.#picture);
  }
}
