// The materials of a model as its author made them; cheaper ones of the same colours and images where software draws.

import { DoubleSide, MeshBasicMaterial, MeshLambertMaterial } from 'three';
import { CLAY } from './surface_shading.js';

const SHARPNESS = 4; // samples along a slanting surface, where a graphics card takes them
const LOOKS = ['name', 'map', 'opacity', 'transparent', 'depthWrite', 'alphaTest', 'vertexColors'];
const LIGHT = ['emissiveMap', 'emissiveIntensity'];
const MAPS = ['map', 'normalMap', 'roughnessMap', 'metalnessMap', 'aoMap', 'emissiveMap'];

/** A material for a mesh of `geometry`: `source` as the loader made it, or the body's own clay where there is none. */
export function surfaceMaterial(source, geometry, software) {
  const flatShading = !geometry.getAttribute('normal');
  const vertexColors = Boolean(geometry.getAttribute('color'));
  if (!source || isBare(source, vertexColors)) return new MeshLambertMaterial({ color: CLAY, side: DoubleSide, flatShading });
  const material = software ? cheaper(source) : source.clone();
  Object.assign(material, { side: DoubleSide, vertexColors });
  if (!material.isMeshBasicMaterial) material.flatShading = flatShading;
  if (material.map && !software) material.map.anisotropy = SHARPNESS;
  return material;
}

/** Whether a material says nothing: white, without an image, on a surface without colours. */
const isBare = ({ color, map, emissiveMap, isMeshBasicMaterial }, vertexColors) =>
  !vertexColors && !map && !emissiveMap && !isMeshBasicMaterial && color.getHex() === 0xffffff;

function cheaper(source) {
  const Kind = source.isMeshBasicMaterial ? MeshBasicMaterial : MeshLambertMaterial;
  const names = source.isMeshBasicMaterial ? LOOKS : [...LOOKS, ...LIGHT];
  const material = new Kind();
  for (const name of names) if (source[name] !== undefined) material[name] = source[name];
  material.color.copy(source.color);
  if (source.emissive && material.emissive) material.emissive.copy(source.emissive);
  return material;
}

/** Give a material's memory back, with that of its images. */
export function disposeMaterial(material) {
  for (const name of MAPS) material[name]?.dispose();
  material.dispose();
}
