// Which of several files belong together: a glTF with what it refers to, a mesh with its motion. Each group is one animation.

import { $ } from '../dom.js';

/** Groups of the files that a person gave, each with its scene first. A file that belongs to no other is a group of its own. */
export async function groupFiles(files) {
  const given = [...files];
  if (given.length < 2) return given.length ? [given] : [];
  const scenes = await Promise.all(given.filter(isScene).map(async (file) => ({ file, ...(await sceneOutline(file)) })));
  if (scenes.length < 2) return [given.toSorted((one, other) => isScene(other) - isScene(one))];
  const rest = new Set(given.filter((file) => !isScene(file)));
  const groups = scenes.map(({ file, refers }) => [file, ...[...rest].filter(({ name }) => refers.has(name) || stem(name) === stem(file.name))]);
  for (const file of groups.flat()) rest.delete(file);
  if (isMeshAndMotion(scenes)) return [[...groups.flat(), ...rest]];
  return [...groups, ...[...rest].map((file) => [file])];
}

/** Whether a file is an animation, and no companion of one. The service writes the endings of both into the page. */
const isScene = ({ name }) => endsIn(name, 'code') && !endsIn(name, '.beside');

const endsIn = (name, which) => [...$('formats').querySelectorAll(which)].some(({ textContent }) => name.toLowerCase().endsWith(textContent));

const stem = (name) => name.replace(/\.[^.]*$/, '');

/** Of two files: one holds the mesh and the other the motion for it. */
const isMeshAndMotion = ([one, other, ...more]) => !more.length && (one.moves !== other.moves || one.mesh !== other.mesh);

/** Whether a scene moves by itself, whether it has a mesh, and the names of the files that it refers to. */
async function sceneOutline(file) {
  try {
    if (/\.gltf$/i.test(file.name)) return gltfOutline(JSON.parse(await file.text()));
    if (/\.glb$/i.test(file.name)) return gltfOutline(await jsonOfGlb(file));
  } catch { /* broken: the service says how */ }
  return { moves: true, mesh: !/\.bvh$/i.test(file.name), refers: new Set() };
}

async function jsonOfGlb(file) {
  const length = new DataView(await file.slice(12, 16).arrayBuffer()).getUint32(0, true);
  return JSON.parse(await file.slice(20, 20 + length).text());
}

function gltfOutline({ animations, meshes, buffers = [], images = [] }) {
  const uris = [...buffers, ...images].map(({ uri }) => uri).filter((uri) => uri && !uri.startsWith('data:'));
  const refers = new Set(uris.map((uri) => decodeURIComponent(uri).split('/').at(-1)));
  return { moves: Boolean(animations?.length), mesh: Boolean(meshes?.length), refers };
}
