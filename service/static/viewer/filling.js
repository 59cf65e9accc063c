// Filling triangles with the processor. Those of a fine figure are as small as pixels, and a renderer that stands in for a
// graphics card takes many times as long over the beginning of each as over its pixels; here there is little to begin.

const EDGE = 1e-6; // of a triangle: a pixel's middle on an edge belongs to both sides, so that no seam shows
const SHORT = 8; // pixels: a row so short is tried pixel by pixel

/**
 * Fill the triangles `t` into `picture`, the nearest on top. `at`: x and y in pixels and the depth of each vertex, flat; no
 * number where it cannot be seen, and with it its triangles. `shades`: its red, green, blue and something, in bytes.
 * `side`: 1 where only triangles that turn anticlockwise are to be seen, -1 clockwise, 0 all.
 */
export function fill({ width, height, left: x0, low: y0, colours, depths }, at, shades, t, side) {
  for (let i = 0; i < t.length; i += 3) {
    const a = t[i];
    let b = t[i + 1], c = t[i + 2];
    const ax = at[3 * a], ay = at[3 * a + 1];
    let ux = at[3 * b] - ax, uy = at[3 * b + 1] - ay, vx = at[3 * c] - ax, vy = at[3 * c + 1] - ay;
    const x = ax - x0, y = ay - y0;
    let turn = ux * vy - uy * vx;
    if (turn * side < 0) continue;
    if (turn < 0) { [b, c] = [c, b]; [ux, uy, vx, vy, turn] = [vx, vy, ux, uy, -turn]; }
    if (!(turn > 0)) continue; // without area, or not in front of the camera
    const low = Math.max(0, Math.ceil(y + Math.min(0, uy, vy) - 0.5)), high = Math.min(height - 1, Math.floor(y + Math.max(0, uy, vy) - 0.5));
    const left = Math.max(0, Math.ceil(x + Math.min(0, ux, vx) - 0.5)), right = Math.min(width - 1, Math.floor(x + Math.max(0, ux, vx) - 0.5));
    if (low > high || left > right) continue;
    // Where a pixel's middle is between the corners: the share of the second, `p`, and of the third, `q`. On the screen, not
    // in space: over a triangle that is small to the eye there is no difference.
    const pStep = vy / turn, qStep = -uy / turn;
    const z = at[3 * a + 2], zp = at[3 * b + 2] - z, zq = at[3 * c + 2] - z;
    const r = shades[4 * a], rp = shades[4 * b] - r, rq = shades[4 * c] - r;
    const g = shades[4 * a + 1], gp = shades[4 * b + 1] - g, gq = shades[4 * c + 1] - g;
    const l = shades[4 * a + 2], lp = shades[4 * b + 2] - l, lq = shades[4 * c + 2] - l;
    for (let row = low; row <= high; row++) {
      const dx = left + 0.5 - x, dy = row + 0.5 - y;
      const p = (dx * vy - dy * vx) / turn, q = (ux * dy - uy * dx) / turn;
      let from = 0, to = right - left;
      if (to > SHORT) {
        for (const [value, step] of [[p, pStep], [q, qStep], [1 - p - q, -pStep - qStep]]) {
          if (step > 0) from = Math.max(from, Math.floor(-value / step));
          else if (step < 0) to = Math.min(to, Math.ceil(-value / step));
        }
      }
      for (let n = from, pixel = row * width + left + from; n <= to; n++, pixel++) {
        const second = p + n * pStep, third = q + n * qStep;
        if (second < -EDGE || third < -EDGE || second + third > 1 + EDGE) continue;
        const depth = z + second * zp + third * zq;
        if (depth >= depths[pixel]) continue;
        depths[pixel] = depth;
        const red = r + second * rp + third * rq, green = g + second * gp + third * gq, blue = l + second * lp + third * lq;
        colours[pixel] = 0xff000000 | (blue << 16) | (green << 8) | red;
      }
    }
  }
}
