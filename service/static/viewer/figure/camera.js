// The camera: where it stands, how it turns about the body, and how it follows it.

import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

const CLOSE = 0.86; // of the usual distance: a portrait may cut off a hand
const ABOVE = 0.02; // of its distance, so high the camera stays above the floor
const FROM = new Vector3(0.62, 0.26, 0.74).normalize(); // a little from the side and above
const SIDES = { front: new Vector3(0, 0, 1), side: new Vector3(1, 0, 0), top: new Vector3(0, 1, 1e-3).normalize() };

export class FigureCamera {
  #controls; #last = new Vector3(); #step = new Vector3(); #framed = { radius: 1, offset: new Vector3() }; #portrait = new PerspectiveCamera(32);

  /** `onChange()` is called when a person turns, moves or zooms, which only one that `turns` lets them. */
  constructor(canvas, onChange, turns = true) {
    this.camera = new PerspectiveCamera(32, 1, 0.01, 1000);
    this.following = true;
    this.floor = -Infinity; // the height of the floor
    this.#controls = new OrbitControls(this.camera, turns ? canvas : null);
    this.#controls.enableDamping = false;
    this.#controls.addEventListener('change', () => { this.#stayAboveFloor(); onChange(); });
  }

  /** Keep the camera and what it looks at above the floor: what is under it cannot be seen from there. */
  #stayAboveFloor() {
    const { position } = this.camera;
    const sunk = Math.max(0, this.floor - this.target.y);
    this.target.y += sunk;
    position.y += sunk;
    const height = (this.target.y - this.floor) / position.distanceTo(this.target) - ABOVE;
    const lowest = Math.PI / 2 + Math.asin(Math.max(-1, Math.min(1, height)));
    if (Math.abs(lowest - this.#controls.maxPolarAngle) < 1e-4) return;
    this.#controls.maxPolarAngle = lowest;
    this.#controls.update(); // comes here again where it moves the camera
  }

  get target() { return this.#controls.target; }

  /** Move back until a sphere about `centre` fits a picture of `width` by `height`; the body's middle is at `middle`. */
  frameSphere(centre, radius, { width, height }, middle) {
    const distance = this.#distance(radius, width / height);
    this.#framed.radius = radius;
    this.#framed.offset.subVectors(centre, middle);
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

  /** How far away a sphere fits a picture of this shape. */
  #distance(radius, shape) { return (radius * 1.05) / Math.sin((this.camera.fov * Math.PI) / 360) / Math.min(1, shape); }

  /** A camera that sees the body alone whose middle is at `middle`, as large as it was framed, in a picture of this shape. */
  portraitOf(middle, shape) {
    const { radius, offset } = this.#framed;
    const distance = this.#distance(radius, shape) * CLOSE;
    const camera = this.#portrait;
    camera.position.addVectors(middle, offset).addScaledVector(FROM, distance);
    camera.lookAt(this.#step.addVectors(middle, offset));
    Object.assign(camera, { aspect: shape, near: distance / 200, far: distance * 4 });
    camera.updateProjectionMatrix();
    return camera;
  }

  /** Look at the same place from the `front`, from the `side` or from the `top`. */
  lookFrom(side) {
    const distance = this.camera.position.distanceTo(this.target);
    this.camera.position.copy(this.target).addScaledVector(SIDES[side], distance);
    this.#controls.update();
  }

  /** Set the view for one of the pictures in `columns` and `rows` on a canvas of `width` by `height`. */
  setView({ width, height }, columns, rows) {
    this.camera.aspect = (width / columns) / (height / rows);
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
