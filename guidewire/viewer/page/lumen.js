// @ts-check
/** @typedef {import("./recording.js").Wall} Wall */
/** @typedef {(pixel: number, depth: number, sign: number) => void} Take */

/**
 * How far the ray through each pixel's middle goes inside a vessel, as LumenThickness of the core: the sum over the
 * triangles that it passes of their depths. Open rims are closed by a fan about their middle.
 */
export class Lumen {
  /** @param {Pick<Wall, "vertices" | "triangles" | "isStill">} wall */
  constructor(wall) {
    this._wall = wall;
    const vertices = [...wall.vertices];
    const triangles = [...wall.triangles];
    closeRims(vertices, triangles);
    this._vertices = Float64Array.from(vertices);
    this._triangles = Uint32Array.from(triangles);
    this._projected = new Float64Array(vertices.length);
  }

  /**
   * Adds its thickness to that of others, units.
   * @param {import("./carm.js").CArm} arm @param {Float32Array} thickness row by row
   */
  add(arm, thickness) {
    const sum = new Float64Array(thickness.length);
    this.sum(arm, sum, 1);
    for (let i = 0; i < sum.length; i++) thickness[i] += Math.max(0, sum[i]) / arm.scale;
  }

  /** Adds so many times what rays pass, pixels' sides. @param {import("./carm.js").CArm} arm @param {Float64Array} sum
   * @param {number} times */
  sum(arm, sum, times) {
    this._project(arm, (pixel, depth, sign) => { sum[pixel] += times * sign * depth; });
  }

  /**
   * Notes where rays pass the wall: pixels, depths (pixels' sides, towards the detector), and 1 where a ray from the
   * detector goes in, else -1.
   * @param {import("./carm.js").CArm} arm @param {{pixels: number[], depths: number[], signs: number[]}} found grows
   */
  cross(arm, { pixels, depths, signs }) {
    this._project(arm, (pixel, depth, sign) => {
      pixels.push(pixel);
      depths.push(depth);
      signs.push(sign);
    });
  }

  /** @param {import("./carm.js").CArm} arm @param {Take} take */
  _project(arm, take) {
    if (!this._wall.isStill) this._vertices.set(this._wall.vertices); // middles of rims stay
    const point = [0, 0, 0];
    for (let i = 0; i < this._vertices.length; i += 3) {
      arm.project(this._vertices, i, point);
      this._projected.set(point, i);
    }
    for (let t = 0; t < this._triangles.length; t += 3) {
      addTriangle(this._projected, 3 * this._triangles[t], 3 * this._triangles[t + 1], 3 * this._triangles[t + 2], take,
        arm.columns, arm.rows);
    }
  }
}

/**
 * @param {Float64Array} p @param {number} a @param {number} b @param {number} c where corners stand
 * @param {Take} take @param {number} columns @param {number} rows
 */
function addTriangle(p, a, b, c, take, columns, rows) {
  const area = (p[b] - p[a]) * (p[c + 1] - p[a + 1]) - (p[c] - p[a]) * (p[b + 1] - p[a + 1]);
  if (area === 0) return;
  const slopeX = ((p[b + 2] - p[a + 2]) * (p[c + 1] - p[a + 1]) - (p[c + 2] - p[a + 2]) * (p[b + 1] - p[a + 1])) / area;
  const slopeY = ((p[c + 2] - p[a + 2]) * (p[b] - p[a]) - (p[b + 2] - p[a + 2]) * (p[c] - p[a])) / area;
  const sign = area < 0 ? -1 : 1;
  const [anchorX, anchorY, anchorZ] = [p[a], p[a + 1], p[a + 2]];
  const isBefore = (/** @type {number} */ one, /** @type {number} */ other) =>
    p[one + 1] < p[other + 1] || (p[one + 1] === p[other + 1] && p[one] < p[other]);
  if (isBefore(b, a)) [a, b] = [b, a];
  if (isBefore(c, b)) [b, c] = [c, b];
  if (isBefore(b, a)) [a, b] = [b, a];
  const crossing = (/** @type {number} */ upper, /** @type {number} */ lower, /** @type {number} */ y) =>
    p[upper] + ((y - p[upper + 1]) / (p[lower + 1] - p[upper + 1])) * (p[lower] - p[upper]);
  const endRow = Math.min(rows, Math.ceil(p[c + 1] - 0.5));
  for (let row = Math.max(0, Math.ceil(p[a + 1] - 0.5)); row < endRow; row++) {
    const y = row + 0.5;
    const one = crossing(a, c, y);
    const other = y < p[b + 1] ? crossing(a, b, y) : crossing(b, c, y);
    const first = Math.max(0, Math.ceil(Math.min(one, other) - 0.5));
    const end = Math.min(columns, Math.ceil(Math.max(one, other) - 0.5));
    let depth = anchorZ + slopeX * (first + 0.5 - anchorX) + slopeY * (y - anchorY);
    for (let k = row * columns + first; k < row * columns + end; k++) {
      take(k, depth, sign);
      depth += slopeX;
    }
  }
}

/** @param {number[]} vertices @param {number[]} triangles both grow */
function closeRims(vertices, triangles) {
  const count = vertices.length / 3;
  const sides = new Set();
  const each = (/** @type {(from: number, to: number) => void} */ tell) => {
    for (let t = 0; t < triangles.length; t += 3) {
      for (let k = 0; k < 3; k++) tell(triangles[t + k], triangles[t + ((k + 1) % 3)]);
    }
  };
  each((from, to) => sides.add(from * count + to));
  /** @type {Map<number, number>} */
  const above = new Map();
  const root = (/** @type {number} */ vertex) => {
    for (let next = above.get(vertex); next !== undefined && next !== vertex; next = above.get(vertex)) vertex = next;
    return vertex;
  };
  /** @type {[number, number][]} */
  const rim = [];
  each((from, to) => {
    if (sides.has(to * count + from)) return;
    rim.push([from, to]);
    above.set(root(from), root(to));
  });
  /** @type {Map<number, number[]>} sum of x, y and z, and their number */
  const sums = new Map();
  for (const [from] of rim) {
    const sum = sums.get(root(from)) ?? [0, 0, 0, 0];
    for (let part = 0; part < 3; part++) sum[part] += vertices[3 * from + part];
    sum[3]++;
    sums.set(root(from), sum);
  }
  /** @type {Map<number, number>} */
  const middles = new Map();
  for (const [key, [x, y, z, number]] of sums) {
    middles.set(key, vertices.length / 3);
    vertices.push(x / number, y / number, z / number);
  }
  for (const [from, to] of rim) triangles.push(to, from, /** @type {number} */ (middles.get(root(from))));
}
