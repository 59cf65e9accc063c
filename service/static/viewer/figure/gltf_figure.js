// The figure of a glTF: the plain copy's one animation, skinned and morphed by WebGL.

import { AnimationMixer, Box3, BufferAttribute, DoubleSide, LoopRepeat, MeshLambertMaterial, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { createSkeleton } from './skeleton.js';
import { orderTriangles } from './triangle_order.js';

/** The figure of a glTF's bytes. */
export const createGltfFigure = async (viewer, bytes, strain) =>
  new GltfFigure(await new GLTFLoader().parseAsync(bytes, ''), viewer, strain);

class GltfFigure {
  #mixer; #action; #clip; #viewer; #points = []; #skeleton = null; #at = new Vector3();

  constructor(gltf, viewer, strain) {
    this.object = gltf.scene;
    this.object.updateMatrixWorld(true);
    this.#viewer = viewer;
    const meshes = [];
    this.object.traverse((node) => {
      if (node.isMesh) meshes.push(node);
      if (node.isBone) this.#points.push(node);
    });
    for (const mesh of meshes) setMaterial(mesh, strain);
    if (viewer.skeleton) {
      this.#skeleton = createSkeleton(this.object);
      this.object.add(this.#skeleton.object);
      this.#points = this.#skeleton.joints;
      strain.shade(this.#skeleton.material);
    }
    if (!this.#points.length) this.object.traverse((node) => { if (node.isMesh) this.#points.push(node); });
    this.#clip = gltf.animations[0];
    if (this.#clip) {
      this.#mixer = new AnimationMixer(this.object);
      this.#action = this.#mixer.clipAction(this.#clip).setLoop(LoopRepeat).play();
    }
    this.pose(0);
  }

  ready() { return true; }

  fetch() { return Promise.resolve(); }

  /** The pose at a frame, or between two: the animation's own curves are smooth. */
  pose(position) {
    if (this.#action) {
      const { start_seconds: start, frame_rate: rate } = this.#viewer;
      // The last instant belongs to the last frame, not to the first of the next round.
      this.#action.time = Math.min(start + position / rate, this.#clip.duration * (1 - 1e-9));
      this.#mixer.update(0);
    }
    this.object.updateMatrixWorld(true);
    this.#skeleton?.update();
  }

  /** The middle of the body: of its joints, or of its parts. */
  centre(out) {
    out.set(0, 0, 0);
    for (const point of this.#points) out.add(this.#at.setFromMatrixPosition(point.matrixWorld));
    return out.divideScalar(Math.max(1, this.#points.length));
  }

  box() {
    const box = new Box3();
    if (this.#skeleton) for (const joint of this.#points) box.expandByPoint(this.#at.setFromMatrixPosition(joint.matrixWorld));
    else box.setFromObject(this.object, true);
    return box;
  }

  dispose() {
    this.#mixer?.stopAllAction();
    this.object.traverse((node) => { node.geometry?.dispose(); node.material?.dispose(); node.skeleton?.dispose(); });
  }
}

function setMaterial(mesh, strain) {
  mesh.frustumCulled = false; // its box is that of the bind pose, and it walks out of it
  const { geometry } = mesh;
  if (!geometry.getAttribute('_patch')) {
    geometry.setAttribute('_patch', new BufferAttribute(new Float32Array(geometry.getAttribute('position').count), 1));
  }
  if (geometry.index) geometry.setIndex(new BufferAttribute(orderTriangles(geometry.index.array), 1));
  mesh.material = strain.shade(new MeshLambertMaterial({ side: DoubleSide, flatShading: !geometry.getAttribute('normal') }));
  if (isMirrored(mesh)) mesh.material.defines = { MIRRORED: '' };
}

/** Whether joints mirror a skinned mesh: then its triangles turn the other way, which only the mesh itself says to three.js. */
function isMirrored({ skeleton, matrixWorld }) {
  if (!skeleton) return false;
  const turned = skeleton.bones[0].matrixWorld.determinant() * skeleton.boneInverses[0].determinant();
  return turned * matrixWorld.determinant() < 0;
}
