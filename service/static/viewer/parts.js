// The modules of the 3D view, asked for all at once: what a module imports, a browser learns only once it has it.

import { make } from './dom.js';

const OURS = ['bones', 'eye', 'figure_gltf', 'figure_vertices', 'floor', 'light', 'locality', 'stage', 'strain'];
const THREE = ['three', 'three/addons/controls/OrbitControls.js', 'three/addons/loaders/GLTFLoader.js',
  'three/addons/utils/BufferGeometryUtils.js', 'three/addons/utils/SkeletonUtils.js'];

/** Begin to fetch them; what is here already is not fetched again. */
export function fetchParts() {
  const three = THREE.map((name) => import.meta.resolve(name));
  const core = new URL('three.core.js', three[0]).href;
  for (const href of [...OURS.map((name) => import.meta.resolve(`./${name}.js`)), ...three, core]) {
    document.head.append(make('link', { rel: 'modulepreload', href }));
  }
}
