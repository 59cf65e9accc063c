// The 3D scene: camera, light, floor and one figure in one pose, or in two side by side. It draws only after a change.

import { Group, MeshLambertMaterial, Scene, Vector3, WebGLRenderer } from 'three';
import { FigureCamera } from './camera.js';
import { onResize, onThemeChange, styleValue } from '../dom.js';
import { skyEnvironment } from './environment.js';
import { createFigureGroup } from './figure_group.js';
import { Floor } from './floor.js';
import { createGltfFigure } from './gltf_figure.js';
import { seenFromAbove, turnBetween } from './heading.js';
import { Light } from './light.js';
import { setEdge, SurfaceShading } from './surface_shading.js';
import { createVertexFigure } from './vertex_figure.js';

const MIRRORED = 0.5; // of the light of the sky that shining materials mirror
const GHOST = 0.3; // of what is behind a ghost it hides
const FINEST = 2; // pixels to a CSS pixel; nobody sees more

const FIGURES = { gltf: createGltfFigure, group: createFigureGroup };

export class FigureScene {
  #renderer; #scene = new Scene(); #camera; #floor = new Floor(); #light = new Light(); #requested = false;
  #middle = new Vector3(); #anchor = new Vector3(); #stand = new Group(); #headings = new Map(); #poses = []; #ghosts = []; #size = { width: 1, height: 1 }; #software;

  /**
   * `software`: the processor draws, so the picture has no anti-aliasing and one pixel for each CSS pixel. `turns`: whether a
   * person turns and moves the camera.
   */
  constructor(canvas, software, { turns = true } = {}) {
    this.canvas = canvas;
    this.#software = software;
    this.figure = null;
    this.columns = Infinity; // of poses side by side; more stand in rows below
    this.ghost = new MeshLambertMaterial({ transparent: true, opacity: GHOST });
    this.strain = new SurfaceShading();
    this.#renderer = rendererOn(canvas, software);
    this.#camera = new FigureCamera(canvas, () => this.draw(), turns);
    if (!software) Object.assign(this.#scene, { environment: skyEnvironment(this.#renderer), environmentIntensity: MIRRORED });
    this.#scene.add(this.#light.object, this.#camera.camera, this.#floor.object, this.#stand);
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
    const strain = new SurfaceShading(colours);
    const create = FIGURES[viewer.kind] ?? createVertexFigure;
    const figure = await create(viewer, model, strain, this.#software);
    if (signal.aborted) return figure.dispose();
    this.clear();
    this.strain = strain;
    this.figure = figure;
    this.#stand.add(figure.object);
    this.reframe();
  }

  /** Put on the model's materials with their images, of the promise of their bytes. Without them it stays plainly coloured. */
  async dress(materials) {
    const { figure } = this;
    await figure.dress(await materials);
    if (figure === this.figure) this.draw();
  }

  clear() {
    if (!this.figure) return;
    this.#stand.remove(this.figure.object);
    this.#headings.clear();
    this.#standStill();
    this.figure.dispose();
    this.strain.dispose();
    this.figure = null;
    this.#poses = [];
    this.draw();
  }

  /**
   * Show one pose, or two side by side: `{ position, colouring }` each, in frames and as in `SurfaceShading.colourBy`. The
   * figure is posed when it is drawn, so that of many calls in one screen frame only the last costs anything. `ghosts` are more
   * poses, seen through. A pose whose motion has a `start` stands where the first pose stands, and has turned since then as far as that
   * one has since its own: bodies that are compared face the same way at first. Answers null, or a promise of the blocks that must be fetched first.
   */
  pose(poses, ghosts = []) {
    this.#poses = poses;
    this.#ghosts = ghosts;
    this.draw();
    const wanted = ({ position, start = position, colouring }) => [[Math.floor(position), colouring === 'strain'], [Math.floor(start), false]];
    const missing = [...poses, ...ghosts].flatMap(wanted)
      .filter(([frame, strained]) => !this.figure.ready(frame) || (strained && !this.strain.ready(frame)));
    if (!missing.length) return null;
    return Promise.all(missing.flatMap(([frame]) => [this.figure.fetch(frame), this.strain.fetch(frame)]));
  }

  /** Move the camera back until it sees the whole figure. */
  reframe() {
    if (!this.figure) return;
    this.#standStill();
    const box = this.figure.box();
    const size = box.getSize(new Vector3());
    const radius = size.length() / 2 || 1;
    this.#camera.floor = box.min.y - radius * 0.002;
    this.#floor.fit(Math.max(size.y, radius * 0.8), Math.max(size.x, size.z), this.#camera.floor);
    this.figure.centre(this.#middle);
    this.#camera.frameSphere(box.getCenter(new Vector3()), radius, this.#size, this.#middle);
    this.draw();
  }

  lookFrom(side) {
    this.#camera.lookFrom(side);
    this.draw();
  }

  /** Stand a figure whose up is z on its feet, or lay it back. */
  setUpAxis(upIsZ) {
    if (!this.figure) return;
    this.figure.object.rotation.x = upIsZ ? -Math.PI / 2 : 0;
    this.figure.object.updateMatrixWorld(true);
    this.#headings.clear();
    this.reframe();
  }

  draw() {
    if (this.#requested) return;
    this.#requested = true;
    requestAnimationFrame(() => { this.#requested = false; this.#render(); });
  }

  /** Show poses at once; answers the milliseconds that it took. */
  drawNow(poses) {
    const begun = performance.now();
    this.#poses = poses;
    this.#render();
    return performance.now() - begun;
  }

  /**
   * Pictures of poses, on nothing: pairs of a frame and a canvas, of as many of `frames` as `budget` milliseconds allow, and of
   * one at least. They are drawn in a corner of the stage and copied from there, and the stage is drawn again before anybody
   * sees it.
   */
  pictures(frames, width, height, budget) {
    if (!this.figure || !frames.length) return [];
    const begun = performance.now();
    const [wide, high] = [Math.min(width, this.#size.width), Math.min(height, this.#size.height)];
    const drawn = [];
    this.#renderer.setScissorTest(true);
    this.#renderer.setViewport(0, 0, wide, high);
    this.#renderer.setScissor(0, 0, wide, high);
    this.#floor.object.visible = false;
    for (const frame of frames) {
      drawn.push([frame, this.#picture(frame, wide, high)]);
      if (performance.now() - begun > budget) break;
    }
    this.#floor.object.visible = true;
    this.#render();
    return drawn;
  }

  #picture(position, wide, high) {
    this.#poseFigure({ position, colouring: null }, false);
    const camera = this.#camera.portraitOf(this.#middle, wide / high);
    this.#light.follow(camera, this.#middle);
    this.#renderer.render(this.#scene, camera);
    const ratio = this.#renderer.getPixelRatio();
    const copy = Object.assign(document.createElement('canvas'), { width: wide, height: high });
    const context = copy.getContext('2d', { willReadFrequently: this.#software });
    context.drawImage(this.canvas, 0, this.canvas.height - high * ratio, wide * ratio, high * ratio, 0, 0, wide, high);
    // Software copies later than asked, and may by then copy another pose: reading a pixel has it copy now.
    if (this.#software) context.getImageData(0, 0, 1, 1);
    return copy;
  }

  #render() {
    const { width, height } = this.#size;
    const share = Math.max(1, this.#poses.length);
    const columns = Math.min(share, this.columns);
    const rows = Math.ceil(share / columns);
    this.#camera.setView(this.#size, columns, rows);
    this.#renderer.setScissorTest(share > 1);
    for (let place = 0; place < share; place++) {
      const row = Math.floor(place / columns);
      const part = [((place % columns) * width) / columns, height - ((row + 1) * height) / rows, width / columns, height / rows];
      this.#renderer.setViewport(...part);
      this.#poseFigure(this.#poses[place], place === 0);
      this.#renderer.setScissor(...part);
      this.#renderer.render(this.#scene, this.#camera.camera);
    }
    if (this.figure && this.#ghosts.length) this.#renderGhosts();
  }

  /** Draw the figure again in other poses, over the picture, behind what is nearer. */
  #renderGhosts() {
    const worn = this.figure.meshes.map((mesh) => mesh.material);
    for (const mesh of this.figure.meshes) mesh.material = this.ghost;
    this.#floor.object.visible = this.#renderer.autoClear = false;
    for (const ghost of this.#ghosts) {
      this.ghost.color.set(ghost.colouring);
      this.#pose(ghost, false);
      this.#renderer.render(this.#scene, this.#camera.camera);
    }
    this.#floor.object.visible = this.#renderer.autoClear = true;
    this.figure.meshes.forEach((mesh, index) => { mesh.material = worn[index]; });
    this.#standStill();
  }

  /** Pose the figure; if its motion has a `start`, stand it where the first pose stands, and turn it as that one faced at first. */
  #pose({ position, start }, first) {
    this.#standStill();
    const turn = first || start === undefined ? 0 : this.#turnTo(start, this.#poses[0].start);
    this.figure.pose(position);
    this.figure.centre(this.#middle);
    if (first) this.#anchor.copy(this.#middle);
    if (first || start === undefined) return;
    this.#stand.rotation.y = turn;
    this.#stand.position.copy(this.#middle).applyEuler(this.#stand.rotation).sub(this.#anchor).negate().setY(0);
    this.#stand.updateMatrixWorld(true);
    this.#middle.set(this.#anchor.x, this.#middle.y, this.#anchor.z);
  }

  /** Radians that the body at frame `start` turns until it faces as at frame `reference`; 0 until both are there. */
  #turnTo(start, reference) {
    const headings = [start, reference].map((frame) => this.#heading(frame));
    return headings.every(Boolean) ? turnBetween(...headings) : 0;
  }

  #heading(frame) {
    if (!this.#headings.has(frame) && this.figure.ready(frame)) {
      this.figure.pose(frame);
      this.#headings.set(frame, seenFromAbove(this.figure.places()));
    }
    return this.#headings.get(frame);
  }

  /** Put the figure back to where its take has it. */
  #standStill() {
    if (this.#stand.position.lengthSq() + this.#stand.rotation.y ** 2 === 0) return; // to go through all joints takes time
    this.#stand.position.set(0, 0, 0);
    this.#stand.rotation.y = 0;
    this.#stand.updateMatrixWorld(true);
  }

  /** Pose and colour the figure; light and floor follow it, and with the first pose the camera does. */
  #poseFigure(pose, first) {
    if (this.figure && pose) {
      this.#pose(pose, first);
      this.strain.colourBy(pose.colouring);
      this.strain.showFrame(Math.floor(pose.position));
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
    setEdge(styleValue('--rim'), Number(styleValue('--edge-shade')));
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
