// @ts-check
/**
 * An instrument as X-rays and the desk see it.
 * @typedef {object} Instrument
 * @property {string} name
 * @property {string} colour of CSS
 * @property {number[]} radii of each element, units
 * @property {number[]} innerRadii units
 * @property {number[]} attenuations 1/unit
 * @property {number[][]} [bands] what is more opaque, such as markers: element, from and to in parts of it, 1/unit
 * @property {number} [tipLoad] N: where its last 10 mm bow out, pressed at the tip
 * @property {number} [shaftLoad] N: where 50 mm of its shaft bow out between fingers and valve
 */

/** Numbers of a piece that the shader takes. */
export const NUMBERS = 12;
const PER_BENT_ELEMENT = 4;
const STRAIGHT_SQUARED = 4e-4; // squared sine: 0.02 rad
const CAP = 2 / 3; // length of a free end, of the radius
const THINNEST = 1e-3; // pixels

/**
 * The straight pieces of instruments in a picture, as InstrumentShadow of the core: for each x and y of its beginning,
 * its direction in the picture, its length there, the extent of its tilted end, the part of it that is a strip, outer
 * and inner radius, depth per chord and even depth, and which ends are free (1: the first, 2: the last). In pixels.
 */
export class Pieces {
  constructor() {
    this.numbers = new Float32Array(1024 * NUMBERS);
    this.count = 0;
  }

  clear() {
    this.count = 0;
  }

  /** @param {Instrument} instrument @param {ArrayLike<number>} x points, units @param {import("./carm.js").CArm} arm */
  add(instrument, x, arm) {
    const last = x.length / 3 - 2;
    let from = arm.project(x, 0, [0, 0, 0]);
    for (let j = 0; j <= last; j++) {
      const end = arm.project(x, 3 * j + 3, [0, 0, 0]);
      const r = instrument.radii[j] * arm.scale;
      const mu = instrument.attenuations[j] / arm.scale;
      if (mu > 0 && !isOutside(from, end, r, arm)) {
        const pieces = isBentAt(x, j) || isBentAt(x, j + 1) ? PER_BENT_ELEMENT : 1;
        let start = from;
        for (let k = 1; k <= pieces; k++) {
          const to = k === pieces ? end : arm.project(curve(x, j, k / pieces), 0, [0, 0, 0]);
          const before = j === 0 && k === 1 ? CAP * r : 0;
          const after = j === last && k === pieces ? CAP * r : 0;
          this._push(start, to, r, instrument.innerRadii[j] * arm.scale, mu, before, after);
          start = to;
        }
      }
      from = end;
    }
    for (const band of instrument.bands ?? []) this._addBand(instrument, band, x, arm);
  }

  /** @param {Instrument} instrument @param {number[]} band @param {ArrayLike<number>} x
   * @param {import("./carm.js").CArm} arm */
  _addBand(instrument, [j, first, last, attenuation], x, arm) {
    const isBent = isBentAt(x, j) || isBentAt(x, j + 1);
    const at = (/** @type {number} */ t) => arm.project(isBent ? curve(x, j, t)
      : [0, 1, 2].map((part) => x[3 * j + part] + t * (x[3 * j + 3 + part] - x[3 * j + part])), 0, [0, 0, 0]);
    const r = instrument.radii[j] * arm.scale;
    let start = at(first);
    if (isOutside(start, at(last), r, arm)) return;
    const pieces = isBent ? PER_BENT_ELEMENT : 1;
    for (let k = 1; k <= pieces; k++) {
      const to = at(first + ((last - first) * k) / pieces);
      this._push(start, to, r, instrument.innerRadii[j] * arm.scale, attenuation / arm.scale, 0, 0);
      start = to;
    }
  }

  /**
   * @param {number[]} from @param {number[]} to @param {number} r @param {number} a @param {number} mu
   * @param {number} before @param {number} after lengths that are added at its ends
   */
  _push(from, to, r, a, mu, before, after) {
    const [dx, dy, dz] = to.map((value, k) => value - from[k]);
    let length = Math.hypot(dx, dy, dz);
    if (!(length > 0)) return;
    const sin = Math.hypot(dx, dy) / length;
    const [ux, uy] = sin > 0 ? [dx / length / sin, dy / length / sin] : [1, 0];
    const x = from[0] - (before * dx) / length;
    const y = from[1] - (before * dy) / length;
    length += before + after;
    const shown = Math.max(sin * length, THINNEST);
    const tilt = Math.max((0.5 * Math.PI * r * Math.abs(dz)) / (length - before - after), THINNEST);
    const peak = Math.min(1, shown / tilt);
    const perChord = (mu * length) / Math.max(shown, tilt);
    const even = ((1 - peak) * perChord * 0.5 * Math.PI * (r - a) * (r + a)) / r;
    if ((this.count + 1) * NUMBERS > this.numbers.length) {
      const longer = new Float32Array(2 * this.numbers.length);
      longer.set(this.numbers);
      this.numbers = longer;
    }
    this.numbers.set([x, y, ux, uy, shown, tilt, peak, r, a, peak * perChord, even,
      (before > 0 ? 1 : 0) + (after > 0 ? 2 : 0)], NUMBERS * this.count++);
  }
}

/** @param {number[]} from @param {number[]} to @param {number} r @param {import("./carm.js").CArm} arm */
function isOutside(from, to, r, { columns, rows }) {
  const slack = 0.3 * Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]) + 2 * r + 2;
  return Math.max(from[0], to[0]) < -slack || Math.min(from[0], to[0]) > columns + slack
    || Math.max(from[1], to[1]) < -slack || Math.min(from[1], to[1]) > rows + slack;
}

/** @param {ArrayLike<number>} x @param {number} i */
function isBentAt(x, i) {
  if (i === 0 || i === x.length / 3 - 1) return false;
  const a = [0, 1, 2].map((part) => x[3 * i + part] - x[3 * i - 3 + part]);
  const b = [0, 1, 2].map((part) => x[3 * i + 3 + part] - x[3 * i + part]);
  const cross = (a[1] * b[2] - a[2] * b[1]) ** 2 + (a[2] * b[0] - a[0] * b[2]) ** 2 + (a[0] * b[1] - a[1] * b[0]) ** 2;
  const [aa, bb] = [a, b].map((v) => v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return cross > STRAIGHT_SQUARED * aa * bb || a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < 0;
}

/** The point of element j at t. @param {ArrayLike<number>} x @param {number} j @param {number} t */
function curve(x, j, t) {
  const last = x.length / 3 - 1;
  const s = 1 - t;
  return [0, 1, 2].map((part) => {
    const a = x[3 * j + part];
    const b = x[3 * j + 3 + part];
    const before = j > 0 ? 0.5 * (b - x[3 * j - 3 + part]) : b - a;
    const after = j + 2 <= last ? 0.5 * (x[3 * j + 6 + part] - a) : b - a;
    return s * s * (1 + 2 * t) * a + t * t * (3 - 2 * t) * b + t * s * s * before - t * t * s * after;
  });
}
