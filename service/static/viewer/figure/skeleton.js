// A skeleton without a mesh: a capsule from each joint to each of its children. A capsule is a rod and a ball at each end, so
// that its ends stay round however long the bone is.

import { BufferAttribute, CylinderGeometry, Group, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion, SphereGeometry, Vector3 } from 'three';

const UP = new Vector3(0, 1, 0);
const THICK = 0.16; // of the median bone's length, the radius of all
const THICKEST = 0.3; // of its own length, the radius of a short one

/** The bones under `root`: `update()` follows the joints' world matrices. */
export function createSkeleton(root) {
  const joints = [];
  root.traverse((node) => { if (node.userData.joint) joints.push(node); });
  const pairs = joints.filter((joint) => joint.parent.userData.joint).map((joint) => [joint.parent, joint]);
  const material = new MeshLambertMaterial();
  const rods = createInstances(new CylinderGeometry(1, 1, 1, 12, 1, true).translate(0, 0.5, 0), material, pairs.length);
  const balls = createInstances(new SphereGeometry(1, 12, 8), material, 2 * pairs.length);
  const [from, to, along, scale] = Array.from({ length: 4 }, () => new Vector3());
  const turn = new Quaternion();
  const matrix = new Matrix4();
  const inverse = new Matrix4();
  const still = new Quaternion();
  let radius = null;
  const ends = ([parent, child]) => {
    from.setFromMatrixPosition(parent.matrixWorld).applyMatrix4(inverse);
    to.setFromMatrixPosition(child.matrixWorld).applyMatrix4(inverse);
    return along.subVectors(to, from).length();
  };
  const update = () => {
    inverse.copy(root.matrixWorld).invert();
    radius ??= THICK * median(pairs.map(ends));
    pairs.forEach((pair, index) => {
      const length = ends(pair);
      const thick = Math.min(radius, THICKEST * length);
      turn.setFromUnitVectors(UP, length ? along.divideScalar(length) : UP);
      rods.setMatrixAt(index, matrix.compose(from, turn, scale.set(thick, length, thick)));
      scale.setScalar(thick);
      balls.setMatrixAt(2 * index, matrix.compose(from, still, scale));
      balls.setMatrixAt(2 * index + 1, matrix.compose(to, still, scale));
    });
    rods.instanceMatrix.needsUpdate = balls.instanceMatrix.needsUpdate = true;
  };
  return { object: new Group().add(rods, balls), joints, material, update };
}

function createInstances(geometry, material, count) {
  geometry.setAttribute('_patch', new BufferAttribute(new Float32Array(geometry.getAttribute('position').count), 1));
  const mesh = new InstancedMesh(geometry, material, Math.max(1, count));
  mesh.frustumCulled = false;
  mesh.count = count;
  return mesh;
}

/** The median of lengths; 1 where there are none. */
const median = (lengths) => lengths.filter(Boolean).sort((a, b) => a - b)[Math.floor(lengths.length / 2)] ?? 1;
