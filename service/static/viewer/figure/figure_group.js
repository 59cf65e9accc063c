// The figures of several takes as one figure, of which one stands at a time: at k + share stands member k, that share into its segment.

import { Group, Vector3 } from 'three';
import { createGltfFigure } from './gltf_figure.js';
import { createVertexFigure } from './vertex_figure.js';

const UNLIKE = 2; // times: bodies that differ by more in size are measured in other units

/**
 * The group of a viewer document's `members`: `{ viewer, files, take, start, end }` each, frames [start, end) of a take. Members of
 * one take share a figure.
 */
export async function createFigureGroup({ members }, _model, shading, software) {
  const figures = new Map();
  for (const { take, viewer, files } of members) {
    if (figures.has(take)) continue;
    figures.set(take, await (viewer.kind === 'gltf' ? createGltfFigure : createVertexFigure)(viewer, await files.model, shading, software));
  }
  await Promise.all(members.map(({ take, start }) => figures.get(take).fetch(start)));
  return new FigureGroup(members.map(({ take, start, end }) => ({ figure: figures.get(take), start, end, loaded: false })));
}

class FigureGroup {
  #members; #stands = new Map(); #shown = null;

  constructor(members) {
    this.#members = members;
    this.object = new Group();
    const figures = [...new Set(members.map(({ figure }) => figure))];
    this.meshes = figures.flatMap((figure) => figure.meshes);
    for (const figure of figures) {
      const stand = new Group().add(figure.object);
      stand.scale.setScalar(unitsBetween(figure, figures[0]));
      this.object.add(stand);
      this.#stands.set(figure, stand);
    }
    this.pose(0);
  }

  /** Whether all of the member's segment can be shown without waiting. */
  ready(position) { return this.#at(position).loaded; }

  async fetch(position) {
    const member = this.#at(position);
    const { figure, start, end } = member;
    await Promise.all(Array.from({ length: end - start }, (_, i) => figure.fetch(start + i)));
    member.loaded = true;
  }

  pose(position) {
    const { figure, start, end } = this.#at(position);
    for (const [one, stand] of this.#stands) stand.visible = one === figure;
    this.#stands.get(figure).updateWorldMatrix(true, false);
    figure.pose(start + (position - Math.floor(position)) * (end - start));
    this.#shown = figure;
  }

  centre(out) { return this.#shown.centre(out); }

  /** Places of the body, by which is told how it faces; of a rig with other joints those of the first, for they tell nothing. */
  places() {
    const [places, first] = [this.#shown, this.#members[0].figure].map((figure) => figure.places());
    return places.length === first.length ? places : first;
  }

  box() { return this.#shown.box(); }

  dispose() { for (const figure of this.#stands.keys()) figure.dispose(); }

  #at(position) { return this.#members[Math.min(this.#members.length - 1, Math.floor(position))]; }
}

/** By what one figure is to be scaled beside another: 1 unless they are measured in other units. */
function unitsBetween(figure, other) {
  const [size, wanted] = [figure, other].map((one) => one.box().getSize(new Vector3()).length());
  const times = size > 0 && wanted > 0 ? wanted / size : 1;
  return times > UNLIKE || times < 1 / UNLIKE ? times : 1;
}
