// @ts-check
/**
 * One cycle of a wall's motion, as `describe` of a session has it: points of the centreline, and at even phases for each of
 * them 12 numbers, its displacement and the matrix by which what is beside it is displaced more. Both are base64 of floats.
 * @typedef {{period: number, phase: number, ramp: number, spacing: number, points: string, displacements: string}} Cycle times in s,
 *     lengths in units
 */

const NEAREST = 8; // points that a place goes with, weighed as the core weighs them

/** @param {string} text */
const floats = (text) => new Float32Array(Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer);

/** Places that go with a wall. The core's map of the moved wall is inverted to the first order: for pictures alone. */
export class Carried {
  /** @param {Float32Array} rest places @param {Cycle[]} cycles */
  constructor(rest, cycles) {
    this.rest = rest;
    this._cycles = cycles.map((cycle) => {
      const points = floats(cycle.points);
      return { ...cycle, points, table: floats(cycle.displacements), now: new Float32Array(4 * points.length),
        ...nearest(rest, points, cycle.spacing) };
    });
  }

  get isMoving() {
    return this._cycles.length > 0;
  }

  /** @param {Float32Array} out @param {number} time s @param {number} [phase] of the first cycle, where that is known */
  move(out, time, phase) {
    out.set(this.rest);
    this._cycles.forEach(({ period, phase: begun, ramp, points, table, now, near, weights }, m) => {
      const count = table.length / now.length;
      const at = (m === 0 && phase !== undefined ? phase : begun + time / period) * count;
      const u = ramp > 0 ? Math.min(1, Math.max(0, time / ramp)) : 1;
      const [before, next] = [0, 1].map((more) => ((((Math.floor(at) + more) % count) + count) % count) * now.length);
      for (let k = 0; k < now.length; k++) {
        now[k] = u ** 3 * (10 - u * (15 - 6 * u)) * (table[before + k] + (at - Math.floor(at)) * (table[next + k] - table[before + k]));
      }
      for (let i = 0, slot = 0; i < out.length; i += 3) {
        for (const end = slot + near.length / (out.length / 3); slot < end; slot++) {
          const [p, d, weight] = [3 * near[slot], 12 * near[slot], weights[slot]];
          const [x, y, z] = [this.rest[i] - points[p], this.rest[i + 1] - points[p + 1], this.rest[i + 2] - points[p + 2]];
          for (let k = 0; k < 3; k++) {
            out[i + k] += weight * (now[d + k] + now[d + 3 + 3 * k] * x + now[d + 4 + 3 * k] * y + now[d + 5 + 3 * k] * z);
          }
        }
      }
    });
  }
}

/** The points that are nearest to each place, and their weights. @param {Float32Array} places @param {Float32Array} points
 * @param {number} spacing */
function nearest(places, points, spacing) {
  const count = points.length / 3;
  const most = Math.min(NEAREST, count);
  const near = new Uint16Array((most * places.length) / 3);
  const weights = new Float32Array(near.length);
  const square = new Float64Array(count);
  for (let i = 0, slot = 0; i < places.length; i += 3, slot += most) {
    const [x, y, z] = places.subarray(i, i + 3);
    for (let k = 0; k < count; k++) square[k] = (points[3 * k] - x) ** 2 + (points[3 * k + 1] - y) ** 2 + (points[3 * k + 2] - z) ** 2;
    for (let n = slot; n < slot + most; n++) {
      for (let k = 1; k < count; k++) if (square[k] < square[near[n]]) near[n] = k;
      weights[n] = square[near[n]];
      square[near[n]] = Infinity;
    }
    const own = weights.subarray(slot, slot + most).map((value, _, all) => Math.exp((all[0] - value) / (2 * spacing * spacing)));
    const sum = own.reduce((total, value) => total + value, 0);
    weights.set(own.map((value) => value / sum), slot);
  }
  return { near, weights };
}
