// A skeleton without a mesh, as animators draw it: a slim octahedron from every joint to each of its children.

import { BufferAttribute, InstancedMesh, Matrix4, MeshLambertMaterial, OctahedronGeometry, Quaternion, Vector3 } from 'three';

const UP = new Vector3(0, 1, 0);

/** The bones under `root`: `update()` follows the joints' world matrices. */
export function bones(root) {
  const joints = [];
  root.traverse((node) => { if (node.userData.joint) joints.push(node); });
  const pairs = joints.filter((joint) => joint.parent.userData.joint).map((joint) => [joint.parent, joint]);
  const geometry = new OctahedronGeometry(0.5);
  geometry.translate(0, 0.5, 0);
  geometry.computeVertexNormals();
  geometry.setAttribute('_patch', new BufferAttribute(new Float32Array(geometry.getAttribute('position').count), 1));
  const material = new MeshLambertMaterial({ flatShading: true });
  const object = new InstancedMesh(geometry, material, Math.max(1, pairs.length));
  object.frustumCulled = false;
  const [from, to, along, place, scale] = Array.from({ length: 5 }, () => new Vector3());
  const turn = new Quaternion();
  const matrix = new Matrix4();
  const inverse = new Matrix4();
  const update = () => {
    inverse.copy(root.matrixWorld).invert();
    pairs.forEach(([parent, child], index) => {
      from.setFromMatrixPosition(parent.matrixWorld).applyMatrix4(inverse);
      to.setFromMatrixPosition(child.matrixWorld).applyMatrix4(inverse);
      const length = along.subVectors(to, from).length();
      turn.setFromUnitVectors(UP, length ? along.divideScalar(length) : UP);
      matrix.compose(place.copy(from), turn, scale.set(length * 0.22, length, length * 0.22));
      object.setMatrixAt(index, matrix);
    });
    object.instanceMatrix.needsUpdate = true;
  };
  return { object, joints, material, update };
}
