// Whether a surface is closed, and which way its triangles face: of a closed one the far half is never seen.

const STRAY = 0.001; // so few of the edges may be open: a mesh that was made lighter has such, and they hide nothing

/** 1 where the triangles of a closed surface face outwards, -1 inwards; 0 where it is open. `positions` is flat. */
export function facing(positions, index) {
  const place = welded(positions);
  const count = positions.length / 3;
  const balance = new Map(); // of every edge: how often it is gone one way less the other
  let volume = 0;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [index[i], index[i + 1], index[i + 2]];
    for (const [from, to] of [[place[a], place[b]], [place[b], place[c]], [place[c], place[a]]]) {
      const key = from < to ? from * count + to : to * count + from;
      balance.set(key, (balance.get(key) || 0) + Math.sign(to - from));
    }
    volume += sixfold(positions, 3 * a, 3 * b, 3 * c);
  }
  let open = 0;
  for (const left of balance.values()) if (left) open += 1;
  return open > STRAY * balance.size ? 0 : Math.sign(volume);
}

/** For every vertex the first that lies where it lies: a seam of the texture is no edge of the surface. */
function welded(positions) {
  const first = new Map();
  return Uint32Array.from({ length: positions.length / 3 }, (_, v) => {
    const key = `${positions[3 * v]},${positions[3 * v + 1]},${positions[3 * v + 2]}`;
    if (!first.has(key)) first.set(key, v);
    return first.get(key);
  });
}

/** Six times the volume between a triangle and the origin, with its sign. */
function sixfold(p, a, b, c) {
  return p[a] * (p[b + 1] * p[c + 2] - p[b + 2] * p[c + 1])
    + p[a + 1] * (p[b + 2] * p[c] - p[b] * p[c + 2])
    + p[a + 2] * (p[b] * p[c + 1] - p[b + 1] * p[c]);
}
