// The camera: where it stands, how it turns about the body, and how it follows it.

import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const FROM = new Vector3(0.62, 0.26, 0.74).normalize(); // a little from the side and above

export class FigureCamera {
  #controls; #last = new Vector3(); #step = new Vector3();

  /** `onChange()` is called when a person turns, moves or zooms. */
  constructor(canvas, onChange) {
    this.camera = new PerspectiveCamera(32, 1, 0.01, 1000);
    this.following = true;
    this.#controls = new OrbitControls(this.camera, canvas);
    this.#controls.enableDamping = false;
    this.#controls.addEventListener('change', onChange);
  }

  get target() { return this.#controls.target; }

  /** Move back until a sphere about `centre` fits a picture of `width` by `height`; the body's middle is at `middle`. */
  frameSphere(centre, radius, { width, height }, middle) {
    const distance = (radius * 1.05) / Math.sin((this.camera.fov * Math.PI) / 360) / Math.min(1, width / height);
    this.camera.position.copy(centre).addScaledVector(FROM, distance);
    this.camera.near = distance / 200;
    this.camera.far = distance * 60;
    this.camera.updateProjectionMatrix();
    this.target.copy(centre);
    this.#controls.minDistance = radius * 0.3;
    this.#controls.maxDistance = distance * 12;
    this.#last.copy(middle);
    this.#controls.update();
  }

  /** Set the view for one of `share` pictures side by side on a canvas of `width` by `height`. */
  setView({ width, height }, share) {
    this.camera.aspect = width / share / height;
    // A half is narrower, so the figure is drawn smaller there: as much of it is seen as on the whole canvas.
    this.camera.zoom = Math.min(1, this.camera.aspect) / Math.min(1, width / height);
    this.camera.updateProjectionMatrix();
  }

  /** Follow the body, whose middle is now at `middle`. */
  follow(middle) {
    if (this.following) {
      this.#step.subVectors(middle, this.#last).setY(0); // the camera stays low when the body jumps
      this.target.add(this.#step);
      this.camera.position.add(this.#step);
    }
    this.#last.copy(middle);
  }
}
