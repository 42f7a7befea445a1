// @ts-check
/** @typedef {import("./carm.js").Point} Point */

const VOXELS = 128;

/**
 * How far the ray through each pixel goes in each cell of a vessel's tree, as LumenCells of the core.
 * A place in the lumen belongs to the cell whose sphere has the least power at the middle of its voxel.
 */
export class LumenCells {
  /** @param {{middles: number[], radii: number[]}} cells units @param {[Point, Point]} box of the vessels, units */
  constructor({ middles, radii }, [low, high]) {
    /** @type {ArrayLike<number>} */
    this._middles = middles;
    this._radii = radii;
    this._low = low;
    const sides = high.map((value, k) => value - low[k]);
    this._side = Math.max(...sides, 1e-9) / VOXELS;
    this._counts = sides.map((side) => Math.trunc(side / this._side) + 1);
    /** Cells of voxels, from 1 on; 0: not asked for yet. */
    this._cells = new Int16Array(this._counts.reduce((all, count) => all * count, 1));
    this._spacing = radii.reduce((sum, radius) => sum + radius, 0) / radii.length;
    /** Pixel and cell of each part of a ray, and its length, units. */
    this._places = new Int32Array(0);
    this._lengths = new Float64Array(0);
  }

  /** Looks at the vessels anew. @param {import("./carm.js").CArm} arm @param {import("./lumen.js").Lumen[]} lumens
   * @param {ArrayLike<number> | null} [middles] where the cells are now; null: where they were */
  look(arm, lumens, middles = null) {
    if (middles) {
      this._middles = middles;
      this._cells.fill(0);
    }
    /** @type {{pixels: number[], depths: number[], signs: number[]}} */
    const found = { pixels: [], depths: [], signs: [] };
    for (const lumen of lumens) lumen.cross(arm, found);
    const order = Uint32Array.from(found.pixels, (_, k) => k).sort((a, b) =>
      found.pixels[a] - found.pixels[b] || found.depths[b] - found.depths[a]);
    /** @type {number[]} */
    const places = [];
    /** @type {number[]} */
    const lengths = [];
    let inside = 0;
    for (let n = 0; n + 1 < order.length; n++) {
      const [k, next] = [order[n], order[n + 1]];
      const pixel = found.pixels[k];
      if (n === 0 || found.pixels[order[n - 1]] !== pixel) inside = 0;
      inside += found.signs[k];
      if (inside > 0 && found.pixels[next] === pixel) {
        this._divide(arm, pixel, found.depths[k], found.depths[next], places, lengths);
      }
    }
    this._places = Int32Array.from(places);
    this._lengths = Float64Array.from(lengths);
  }

  /** Adds up the agent along each ray, part times units. @param {Float64Array} parts of the blood in each cell
   * @param {Float64Array} sum row by row; begins anew */
  sum(parts, sum) {
    sum.fill(0);
    for (let k = 0; k < this._lengths.length; k++) {
      sum[this._places[2 * k]] += parts[this._places[2 * k + 1]] * this._lengths[k];
    }
  }

  /**
   * @param {import("./carm.js").CArm} arm @param {number} pixel @param {number} from depth @param {number} to
   * @param {number[]} places @param {number[]} lengths both grow
   */
  _divide(arm, pixel, from, to, places, lengths) {
    const x = (pixel % arm.columns) + 0.5;
    const y = Math.trunc(pixel / arm.columns) + 0.5;
    const length = (from - to) / arm.scale;
    const count = Math.max(1, Math.ceil(length / this._spacing));
    for (let k = 0; k < count; k++) {
      places.push(pixel, this._cellAt(arm.place(x, y, from + ((k + 0.5) / count) * (to - from))));
      lengths.push(length / count);
    }
  }

  /** @param {number[]} point */
  _cellAt(point) {
    const [i, j, k] = point.map((value, axis) =>
      Math.max(0, Math.min(this._counts[axis] - 1, Math.floor((value - this._low[axis]) / this._side))));
    const voxel = (i * this._counts[1] + j) * this._counts[2] + k;
    if (!this._cells[voxel]) {
      this._cells[voxel] = 1 + this._nearest(...[i, j, k].map((at, axis) => this._low[axis] + this._side * (at + 0.5)));
    }
    return this._cells[voxel] - 1;
  }

  /** @param {number[]} point x, y and z */
  _nearest(...point) {
    const [x, y, z] = point;
    let best = 0;
    let least = Infinity;
    this._radii.forEach((radius, k) => {
      const [a, b, c] = [x - this._middles[3 * k], y - this._middles[3 * k + 1], z - this._middles[3 * k + 2]];
      const power = a * a + b * b + c * c - radius * radius;
      if (power < least) [least, best] = [power, k];
    });
    return best;
  }
}
