// @ts-check
/** @typedef {[number, number, number]} Point */

/**
 * Where a fluoroscopic picture is taken from, as CArm of the core: the head is towards +z, the chest towards +x, the
 * left side towards +y; rays are parallel. LAO and cranial angles are positive.
 */
export class CArm {
  /**
   * @param {number} lao degrees @param {number} cranial degrees @param {Point} centre units
   * @param {number} field side of the picture, units @param {number} pixels of a side
   */
  constructor(lao, cranial, centre, field, pixels) {
    const [a, b] = [lao, cranial].map((angle) => (angle * Math.PI) / 180);
    this.centre = centre;
    this.pixels = pixels;
    /** Pixels per unit. */
    this.scale = pixels / field;
    this._towards = [Math.cos(b) * Math.cos(a), Math.cos(b) * Math.sin(a), Math.sin(b)];
    this._up = [-Math.sin(b) * Math.cos(a), -Math.sin(b) * Math.sin(a), Math.cos(b)];
    this._right = [-Math.sin(a), Math.cos(a), 0];
  }

  /**
   * A point in pixels: x to the right and y down from the upper left corner, z towards the detector.
   * @param {ArrayLike<number>} points units @param {number} at where its x stands @param {number[]} out
   */
  project(points, at, out) {
    const x = this.scale * (points[at] - this.centre[0]);
    const y = this.scale * (points[at + 1] - this.centre[1]);
    const z = this.scale * (points[at + 2] - this.centre[2]);
    out[0] = 0.5 * this.pixels + x * this._right[0] + y * this._right[1] + z * this._right[2];
    out[1] = 0.5 * this.pixels - (x * this._up[0] + y * this._up[1] + z * this._up[2]);
    out[2] = x * this._towards[0] + y * this._towards[1] + z * this._towards[2];
    return out;
  }

  /**
   * The side of a picture in which a box is seen from its middle, units.
   * @param {number} lao @param {number} cranial @param {Point} low corner, units @param {Point} high
   */
  static framing(lao, cranial, low, high) {
    const middle = /** @type {Point} */ (low.map((value, k) => 0.5 * (value + high[k])));
    const look = new CArm(lao, cranial, middle, 1, 1);
    let side = 1e-9;
    for (let corner = 0; corner < 8; corner++) {
      const [x, y] = look.project([corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
        corner & 4 ? high[2] : low[2]], 0, [0, 0, 0]);
      side = Math.max(side, 2.1 * Math.abs(x - 0.5), 2.1 * Math.abs(y - 0.5));
    }
    return side;
  }
}
