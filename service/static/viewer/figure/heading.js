// Which way a body faces, told from another pose of the same body: how far one must turn about the vertical to lie best on the
// other (the plane case of Kabsch, 1976).

/** Points around their own middle, seen from above: x and z in turns. `points` are x, y, z in turns. */
export function seenFromAbove(points) {
  const count = points.length / 3;
  let [x, z] = [0, 0];
  for (let i = 0; i < points.length; i += 3) { x += points[i] / count; z += points[i + 2] / count; }
  return Float32Array.from({ length: 2 * count }, (_, i) => (i % 2 ? points[(i >> 1) * 3 + 2] - z : points[(i >> 1) * 3] - x));
}

/** Radians about the upward axis that turn `from` until it faces as `to` does; both are of `seenFromAbove`. */
export function turnBetween(from, to) {
  let [along, across] = [0, 0];
  for (let i = 0; i < from.length; i += 2) {
    along += to[i] * from[i] + to[i + 1] * from[i + 1];
    across += to[i] * from[i + 1] - to[i + 1] * from[i];
  }
  return Math.atan2(across, along);
}
