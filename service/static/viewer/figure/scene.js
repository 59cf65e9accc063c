// The 3D view: camera, light, floor and one figure, at one moment or at two side by side. Draws only when something changed.

import { DirectionalLight, Group, HemisphereLight, Scene, Vector3, WebGLRenderer } from 'three';
import { Eye } from './camera.js';
import { onResize, onTheme, styled } from '../dom.js';
import { Floor } from './floor.js';
import { gltfFigure } from './gltf_figure.js';
import { Strain } from './strain_shading.js';
import { verticesFigure } from './vertex_figure.js';

const FINEST = 2; // pixels to a CSS pixel; more is not seen

export class Stage {
  #renderer; #scene = new Scene(); #eye; #floor = new Floor(); #light = new Light(); #asked = false;
  #middle = new Vector3(); #moments = []; #size = { width: 1, height: 1 };

  constructor(canvas) {
    this.canvas = canvas;
    this.figure = null;
    this.strain = new Strain();
    this.#renderer = rendererOn(canvas);
    this.#eye = new Eye(canvas, () => this.draw());
    this.#scene.add(this.#light.object, this.#eye.camera, this.#floor.object);
    onResize(canvas.parentElement, () => this.#fit());
    onTheme(() => this.#theme());
    this.#theme();
    this.#fit();
    this.#renderer.compile(this.#scene, this.#eye.camera); // while the figure is on its way
  }

  /** Whether the camera goes along with the body. */
  set following(on) { this.#eye.following = on; }

  /** Show what the service's viewer document names, `coming` as `askFigure` answers it, in place of what was there. */
  async show(viewer, coming, signal) {
    const [model, colours] = await Promise.all([coming.model, coming.strain]);
    const strain = new Strain(colours);
    const figure = await (viewer.kind === 'gltf' ? gltfFigure : verticesFigure)(viewer, model, strain);
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
    this.#moments = [];
    this.draw();
  }

  /**
   * Show moments, one or two side by side: `{ position, look }` each, in frames and as in `Strain.look`. They are posed
   * when they are drawn, so that of many in one screen frame only the last costs anything. Answers null, or a promise
   * of what had to be fetched first.
   */
  pose(moments) {
    this.#moments = moments;
    this.draw();
    const missing = moments.map(({ position, look }) => [Math.floor(position), look === 'strain'])
      .filter(([frame, heated]) => !this.figure.ready(frame) || (heated && !this.strain.ready(frame)));
    if (!missing.length) return null;
    return Promise.all(missing.flatMap(([frame]) => [this.figure.fetch(frame), this.strain.fetch(frame)]));
  }

  /** Stand back until the whole figure is seen. */
  reframe() {
    if (!this.figure) return;
    const box = this.figure.box();
    const size = box.getSize(new Vector3());
    const radius = size.length() / 2 || 1;
    this.#floor.fit(Math.max(size.y, radius * 0.8), Math.max(size.x, size.z), box.min.y - radius * 0.002);
    this.figure.centre(this.#middle);
    this.#eye.standBack(box.getCenter(new Vector3()), radius, this.#size, this.#middle);
    this.draw();
  }

  /** Stand a figure whose up is z on its feet, or lay it back. */
  turn(upIsZ) {
    if (!this.figure) return;
    this.figure.object.rotation.x = upIsZ ? -Math.PI / 2 : 0;
    this.figure.object.updateMatrixWorld(true);
    this.reframe();
  }

  draw() {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => { this.#asked = false; this.#render(); });
  }

  #render() {
    const { width, height } = this.#size;
    const share = Math.max(1, this.#moments.length);
    this.#eye.look(this.#size, share);
    this.#renderer.setScissorTest(share > 1);
    for (let place = 0; place < share; place++) {
      this.#renderer.setViewport((place * width) / share, 0, width / share, height);
      this.#act(this.#moments[place], place === 0);
      this.#renderer.setScissor((place * width) / share, 0, width / share, height);
      this.#renderer.render(this.#scene, this.#eye.camera);
    }
  }

  /** Pose and colour the figure; light and floor go with it, and with the first moment the camera. */
  #act(moment, first) {
    if (this.figure && moment) {
      this.figure.pose(moment.position);
      this.strain.look(moment.look);
      this.strain.show(Math.floor(moment.position));
      this.figure.centre(this.#middle);
      if (first) this.#eye.follow(this.#middle);
    }
    const { camera, target } = this.#eye;
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
    this.#floor.colours(styled('--grid'), styled('--shade'));
    this.draw();
  }
}

/** A renderer in WebGL, by the graphics card or by the browser's own software. */
function rendererOn(canvas) {
  const ratio = Math.min(devicePixelRatio, FINEST);
  const context = canvas.getContext('webgl2', { alpha: true, antialias: ratio < FINEST });
  if (!context) throw new Error('this browser does not offer WebGL 2. Everything else on this page works.');
  const renderer = new WebGLRenderer({ canvas, context });
  renderer.setPixelRatio(ratio);
  return renderer;
}

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
