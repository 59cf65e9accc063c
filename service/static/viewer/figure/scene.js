// The 3D scene: camera, light, floor and one figure in one pose, or in two side by side. It draws only after a change.

import { DirectionalLight, Group, HemisphereLight, Scene, Vector3, WebGLRenderer } from 'three';
import { FigureCamera } from './camera.js';
import { onResize, onThemeChange, styleValue } from '../dom.js';
import { Floor } from './floor.js';
import { createGltfFigure } from './gltf_figure.js';
import { StrainShading } from './strain_shading.js';
import { createVertexFigure } from './vertex_figure.js';

const FINEST = 2; // pixels to a CSS pixel; nobody sees more

export class FigureScene {
  #renderer; #scene = new Scene(); #camera; #floor = new Floor(); #light = new Light(); #requested = false;
  #middle = new Vector3(); #poses = []; #size = { width: 1, height: 1 };

  /** `software`: the processor draws, so the picture has no anti-aliasing and one pixel for each CSS pixel. */
  constructor(canvas, software) {
    this.canvas = canvas;
    this.figure = null;
    this.strain = new StrainShading();
    this.#renderer = rendererOn(canvas, software);
    this.#camera = new FigureCamera(canvas, () => this.draw());
    this.#scene.add(this.#light.object, this.#camera.camera, this.#floor.object);
    onResize(canvas.parentElement, () => this.#fit());
    onThemeChange(() => this.#theme());
    this.#theme();
    this.#fit();
    this.#renderer.compile(this.#scene, this.#camera.camera); // while the figure is on its way
  }

  /** Whether the camera follows the body. */
  set following(on) { this.#camera.following = on; }

  /** Show the figure of a viewer document, from the `files` of `downloadFigure`, in place of the one before. */
  async show(viewer, files, signal) {
    const [model, colours] = await Promise.all([files.model, files.strain]);
    const strain = new StrainShading(colours);
    const figure = await (viewer.kind === 'gltf' ? createGltfFigure : createVertexFigure)(viewer, model, strain);
    if (signal.aborted) return figure.dispose();
    this.clear();
    this.strain = strain;
    this.figure = figure;
    this.#scene.add(figure.object);
    this.reframe();
  }

  clear() {
    if (!this.figure) return;
    this.#scene.remove(this.figure.object);
    this.figure.dispose();
    this.strain.dispose();
    this.figure = null;
    this.#poses = [];
    this.draw();
  }

  /**
   * Show one pose, or two side by side: `{ position, colouring }` each, in frames and as in `StrainShading.colourBy`. The
   * figure is posed when it is drawn, so that of many calls in one screen frame only the last costs anything. Answers null,
   * or a promise of the blocks that must be fetched first.
   */
  pose(poses) {
    this.#poses = poses;
    this.draw();
    const missing = poses.map(({ position, colouring }) => [Math.floor(position), colouring === 'strain'])
      .filter(([frame, strained]) => !this.figure.ready(frame) || (strained && !this.strain.ready(frame)));
    if (!missing.length) return null;
    return Promise.all(missing.flatMap(([frame]) => [this.figure.fetch(frame), this.strain.fetch(frame)]));
  }

  /** Move the camera back until it sees the whole figure. */
  reframe() {
    if (!this.figure) return;
    const box = this.figure.box();
    const size = box.getSize(new Vector3());
    const radius = size.length() / 2 || 1;
    this.#floor.fit(Math.max(size.y, radius * 0.8), Math.max(size.x, size.z), box.min.y - radius * 0.002);
    this.figure.centre(this.#middle);
    this.#camera.frameSphere(box.getCenter(new Vector3()), radius, this.#size, this.#middle);
    this.draw();
  }

  /** Stand a figure whose up is z on its feet, or lay it back. */
  setUpAxis(upIsZ) {
    if (!this.figure) return;
    this.figure.object.rotation.x = upIsZ ? -Math.PI / 2 : 0;
    this.figure.object.updateMatrixWorld(true);
    this.reframe();
  }

  draw() {
    if (this.#requested) return;
    this.#requested = true;
    requestAnimationFrame(() => { this.#requested = false; this.#render(); });
  }

  #render() {
    const { width, height } = this.#size;
    const share = Math.max(1, this.#poses.length);
    this.#camera.setView(this.#size, share);
    this.#renderer.setScissorTest(share > 1);
    for (let place = 0; place < share; place++) {
      this.#renderer.setViewport((place * width) / share, 0, width / share, height);
      this.#poseFigure(this.#poses[place], place === 0);
      this.#renderer.setScissor((place * width) / share, 0, width / share, height);
      this.#renderer.render(this.#scene, this.#camera.camera);
    }
  }

  /** Pose and colour the figure; light and floor follow it, and with the first pose the camera does. */
  #poseFigure(pose, first) {
    if (this.figure && pose) {
      this.figure.pose(pose.position);
      this.strain.colourBy(pose.colouring);
      this.strain.showFrame(Math.floor(pose.position));
      this.figure.centre(this.#middle);
      if (first) this.#camera.follow(this.#middle);
    }
    const { camera, target } = this.#camera;
    this.#floor.follow(target, this.#middle);
    this.#light.follow(camera, target);
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (!width || !height) return;
    this.#size = { width, height };
    this.#renderer.setSize(width, height, false);
    this.draw();
  }

  #theme() {
    this.#floor.setColours(styleValue('--grid'), styleValue('--shade'));
    this.draw();
  }
}

function rendererOn(canvas, software) {
  const context = canvas.getContext('webgl2', { alpha: true, antialias: !software });
  if (!context) throw new Error('this browser does not offer WebGL 2. Everything else on this page works.');
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.setPixelRatio(software ? 1 : Math.min(devicePixelRatio, FINEST));
  return renderer;
}

/** A sky, a key light over the viewer's left shoulder, so that no side of the figure is dark, and a rim from behind. */
class Light {
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
