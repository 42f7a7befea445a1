// @ts-check
/**
 * One cycle of a wall's motion, as `describe` of a session has it: points of the centreline, and at even phases for each of
 * them 12 numbers, its displacement and the matrix by which what is beside it is displaced more. Both are base64 of floats.
 * @typedef {{period: number, phase: number, ramp: number, spacing: number, points: string, displacements: string}} Cycle times in s,
 *     lengths in units
 */

const NEAREST = 8; // points that a place goes with, weighed as the core weighs them
const SWEEPS = 30;
const PER_PIECE = 4; // points that are drawn of a beam, for each that is known

/** @param {string} text */
const floats = (text) => new Float32Array(Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer);

/** Places that go with a wall. The core's map of the moved wall is inverted to the first order: for pictures alone. */
export class Carried {
  /** @param {Float32Array} rest places @param {Cycle[]} cycles
   * @param {Float64Array} [centreline] of a vessel that gives way as a beam: points at rest, each with its displacement */
  constructor(rest, cycles, centreline) {
    this.rest = rest;
    if (centreline) {
      const points = fine(centreline, 0);
      const [x, y, z] = [0, 1, 2].map((k) => points[3 + k] - points[k]);
      this._beam = { points, now: new Float32Array(4 * points.length), ...nearest(rest, points, Math.hypot(x, y, z)) };
    }
    this._cycles = cycles.map((cycle) => {
      const points = floats(cycle.points);
      return { ...cycle, points, table: floats(cycle.displacements), now: new Float32Array(4 * points.length),
        ...nearest(rest, points, cycle.spacing) };
    });
  }

  get isMoving() {
    return this._cycles.length > 0 || this._beam !== undefined;
  }

  /** @param {Float32Array} out @param {number} time s @param {number} [phase] of the first cycle, where that is known
   * @param {Float64Array} [centreline] of the beam */
  move(out, time, phase, centreline) {
    out.set(this.rest);
    if (this._beam && centreline) {
      bend(this._beam.points, fine(centreline, 3), this._beam.now);
      this._add(out, this._beam);
    }
    this._cycles.forEach((cycle, m) => {
      const { period, phase: begun, ramp, table, now } = cycle;
      const count = table.length / now.length;
      const at = (m === 0 && phase !== undefined ? phase : begun + time / period) * count;
      const u = ramp > 0 ? Math.min(1, Math.max(0, time / ramp)) : 1;
      const [before, next] = [0, 1].map((more) => ((((Math.floor(at) + more) % count) + count) % count) * now.length);
      for (let k = 0; k < now.length; k++) {
        now[k] = u ** 3 * (10 - u * (15 - 6 * u)) * (table[before + k] + (at - Math.floor(at)) * (table[next + k] - table[before + k]));
      }
      this._add(out, cycle);
    });
  }

  /** Adds displacements. @param {Float32Array} out
   * @param {{points: Float32Array, now: Float32Array, near: Uint16Array, weights: Float32Array}} field */
  _add(out, { points, now, near, weights }) {
    for (let i = 0, slot = 0; i < out.length; i += 3) {
      for (const end = slot + near.length / (out.length / 3); slot < end; slot++) {
        const [p, d, weight] = [3 * near[slot], 12 * near[slot], weights[slot]];
        const [x, y, z] = [this.rest[i] - points[p], this.rest[i + 1] - points[p + 1], this.rest[i + 2] - points[p + 2]];
        for (let k = 0; k < 3; k++) {
          out[i + k] += weight * (now[d + k] + now[d + 3 + 3 * k] * x + now[d + 4 + 3 * k] * y + now[d + 5 + 3 * k] * z);
        }
      }
    }
  }
}

/** Points of a cubic spline through those that are known. @param {Float64Array} known six numbers a point
 * @param {number} first of the three that are taken */
function fine(known, first) {
  const last = known.length / 6 - 1;
  const points = new Float32Array(3 * (PER_PIECE * last + 1));
  for (let axis = 0; axis < 3; axis++) {
    const p = Float64Array.from({ length: last + 1 }, (_, k) => known[6 * k + first + axis]);
    // Slopes: at the ends by cubics through four points, and between them by sweeps, each of which halves the error.
    const end = (/** @type {number} */ k, /** @type {number} */ step) => last < 3 ? p[1] - p[0]
      : (step * (18 * p[k + step] - 11 * p[k] - 9 * p[k + 2 * step] + 2 * p[k + 3 * step])) / 6;
    const slopes = new Float64Array(last + 1);
    [slopes[0], slopes[last]] = [end(0, 1), end(last, -1)];
    for (let sweep = 0; sweep < SWEEPS; sweep++) {
      for (let k = 1; k < last; k++) slopes[k] = 0.25 * (3 * (p[k + 1] - p[k - 1]) - slopes[k - 1] - slopes[k + 1]);
    }
    for (let i = 0; i <= PER_PIECE * last; i++) {
      const k = Math.min(Math.trunc(i / PER_PIECE), last - 1);
      const [u, v] = [i / PER_PIECE - k, 1 - i / PER_PIECE + k];
      points[3 * i + axis] = v * v * ((1 + 2 * u) * p[k] + u * slopes[k]) + u * u * ((1 + 2 * v) * p[k + 1] - v * slopes[k + 1]);
    }
  }
  return points;
}

/** Sets what sections do that go and turn with a centreline. @param {Float32Array} points at rest
 * @param {Float32Array} displaced @param {Float32Array} now as a row of a cycle */
function bend(points, displaced, now) {
  const last = points.length - 3;
  const along = (/** @type {number} */ i, /** @type {number} */ share) => {
    // By parabolas through three points, at the ends too.
    const middle = Math.max(3, Math.min(last - 3, i));
    const way = [0, 1, 2].map((k) => {
      const [a, b, c] = [-3, 0, 3].map((step) => points[middle + step + k] + share * displaced[middle + step + k]);
      return 0.5 * (c - a) + ((i - middle) / 3) * (a - 2 * b + c);
    });
    return way.map((value) => value / Math.hypot(...way));
  };
  for (let i = 0; i < points.length; i += 3) {
    // The shortest turn from s to t, less 1: with a = s x t it is (cos - 1) 1 + [a] + a a^T/(1 + cos).
    const [s, t] = [along(i, 0), along(i, 1)];
    const a = [s[1] * t[2] - s[2] * t[1], s[2] * t[0] - s[0] * t[2], s[0] * t[1] - s[1] * t[0]];
    const cosine = s[0] * t[0] + s[1] * t[1] + s[2] * t[2];
    for (let k = 0; k < 3; k++) {
      now[4 * i + k] = displaced[i + k];
      for (let l = 0; l < 3; l++) {
        now[4 * i + 3 + 3 * k + l] = t[k] * s[l] - s[k] * t[l] + (k === l ? cosine - 1 : 0) + (a[k] * a[l]) / (1 + cosine);
      }
    }
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
