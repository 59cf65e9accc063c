// The figure of a glTF: the plain copy's one animation, skinned and morphed by WebGL.

import { AnimationMixer, Box3, BufferAttribute, LoopRepeat, Vector3 } from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { disposeMaterial, surfaceMaterial } from './materials.js';
import { createSkeleton } from './skeleton.js';
import { orderTriangles } from './triangle_order.js';

/** The figure of a glTF's bytes, drawn by `software` or by a graphics card. */
export const createGltfFigure = async (viewer, bytes, shading, software) =>
  new GltfFigure(await new GLTFLoader().parseAsync(bytes, ''), viewer, shading, software);

class GltfFigure {
  #mixer; #action; #clip; #viewer; #shading; #software; #points = []; #skeleton = null; #at = new Vector3();

  constructor(gltf, viewer, shading, software) {
    this.object = gltf.scene;
    this.object.updateMatrixWorld(true);
    this.#viewer = viewer;
    this.#shading = shading;
    this.#software = software;
    this.meshes = [];
    this.object.traverse((node) => {
      if (node.isMesh) this.meshes.push(node);
      if (node.isBone) this.#points.push(node);
    });
    for (const mesh of this.meshes) this.#prepare(mesh);
    if (viewer.skeleton) {
      this.#skeleton = createSkeleton(this.object);
      this.object.add(this.#skeleton.object);
      this.#points = this.#skeleton.joints;
      this.meshes.push(...this.#skeleton.object.children);
      shading.shade(this.#skeleton.material);
    }
    if (!this.#points.length) this.object.traverse((node) => { if (node.isMesh) this.#points.push(node); });
    this.#clip = gltf.animations[0];
    if (this.#clip) {
      this.#mixer = new AnimationMixer(this.object);
      this.#action = this.#mixer.clipAction(this.#clip).setLoop(LoopRepeat).play();
    }
    this.pose(0);
  }

  #prepare(mesh) {
    mesh.frustumCulled = false; // its box is that of the bind pose, and it walks out of it
    const { geometry } = mesh;
    if (!geometry.getAttribute('_patch')) {
      geometry.setAttribute('_patch', new BufferAttribute(new Float32Array(geometry.getAttribute('position').count), 1));
    }
    if (geometry.index) geometry.setIndex(new BufferAttribute(orderTriangles(geometry.index.array), 1));
    mesh.userData.material = mesh.material.userData.number;
    this.#setMaterial(mesh, mesh.userData.material === undefined ? null : mesh.material);
  }

  #setMaterial(mesh, source) {
    mesh.material = this.#shading.shade(surfaceMaterial(source, mesh.geometry, this.#software));
    if (isMirrored(mesh)) mesh.material.defines = { ...mesh.material.defines, MIRRORED: '' };
  }

  /** Put on the materials with their images, of the bytes of a glTF that has nothing else. */
  async dress(bytes) {
    const { parser } = await new GLTFLoader().parseAsync(bytes, '');
    const materials = await parser.getDependencies('material');
    for (const mesh of this.meshes) {
      const source = materials[mesh.userData.material];
      if (!source) continue;
      mesh.material.dispose();
      this.#setMaterial(mesh, source);
    }
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

  /** Places of the body: x, y, z of each of its joints, or of its parts. */
  places() { return this.#points.flatMap((point) => this.#at.setFromMatrixPosition(point.matrixWorld).toArray()); }

  box() {
    const box = new Box3();
    if (this.#skeleton) for (const joint of this.#points) box.expandByPoint(this.#at.setFromMatrixPosition(joint.matrixWorld));
    else box.setFromObject(this.object, true);
    return box;
  }

  dispose() {
    this.#mixer?.stopAllAction();
    this.object.traverse((node) => node.skeleton?.dispose());
    for (const mesh of this.meshes) {
      mesh.geometry.dispose();
      disposeMaterial(mesh.material);
    }
  }
}

/** Whether joints mirror a skinned mesh: then its triangles turn the other way, which only the mesh itself says to three.js. */
function isMirrored({ skeleton, matrixWorld }) {
  if (!skeleton) return false;
  const turned = skeleton.bones[0].matrixWorld.determinant() * skeleton.boneInverses[0].determinant();
  return turned * matrixWorld.determinant() < 0;
}
