// A curve with as many points as the screen has columns: the lowest and the highest of each column are kept, so that
// no peak is lost however many frames a column stands for.

/** [frames, values] of `values[from…to)`, at most two points a column; null where there is no value. */
export function decimate(values, from, to, columns) {
  const first = Math.max(0, Math.floor(from) - 1);
  const last = Math.min(values.length, Math.ceil(to) + 2);
  if (last - first <= 2 * columns) {
    const frames = Array.from({ length: last - first }, (_, i) => first + i);
    return [frames, frames.map((frame) => values[frame])];
  }
  const frames = [];
  const kept = [];
  const width = (last - first) / columns;
  for (let column = 0; column < columns; column++) {
    const start = first + Math.floor(column * width);
    const stop = Math.min(last, first + Math.floor((column + 1) * width));
    let low = -1;
    let high = -1;
    for (let frame = start; frame < stop; frame++) {
      if (values[frame] === null) continue;
      if (low < 0 || values[frame] < values[low]) low = frame;
      if (high < 0 || values[frame] > values[high]) high = frame;
    }
    if (low < 0) { frames.push(start); kept.push(null); continue; }
    frames.push(Math.min(low, high));
    kept.push(values[Math.min(low, high)]);
    if (low !== high) { frames.push(Math.max(low, high)); kept.push(values[Math.max(low, high)]); }
  }
  return [frames, kept];
}
