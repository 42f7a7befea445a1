// @ts-check
/** @typedef {[number, number, number]} Point */

/**
 * How a patient lies: unit vectors to the left side, the chest and the head, and where the origin lies in
 * a generic one, mm to the left, the back and the head.
 * @typedef {{left: Point, chest: Point, head: Point, origin?: Point | null}} Patient
 */
/** Where nobody says it, as PatientAxes of the core. @type {Patient} */
export const UNKNOWN = { left: [0, 1, 0], chest: [1, 0, 0], head: [0, 0, 1] };

/** Where a fluoroscopic picture is taken from, as CArm of the core: rays are parallel, LAO and cranial are positive. */
export class CArm {
  /**
   * @param {number} lao degrees @param {number} cranial degrees @param {Point} centre units
   * @param {number} field shorter side of the picture, units @param {number} columns of pixels @param {Patient} patient
   * @param {number} rows
   */
  constructor(lao, cranial, centre, field, columns, patient = UNKNOWN, rows = columns) {
    const [a, b] = [lao, cranial].map((angle) => (angle * Math.PI) / 180);
    this.centre = centre;
    this.columns = columns;
    this.rows = rows;
    /** Pixels per unit. */
    this.scale = Math.min(columns, rows) / field;
    const { left, chest, head } = patient;
    const level = chest.map((value, k) => Math.cos(a) * value + Math.sin(a) * left[k]);
    this.head = head;
    this.towards = level.map((value, k) => Math.cos(b) * value + Math.sin(b) * head[k]);
    this.up = level.map((value, k) => Math.cos(b) * head[k] - Math.sin(b) * value);
    this.right = left.map((value, k) => Math.cos(a) * value - Math.sin(a) * chest[k]);
  }

  /**
   * A point in pixels: x to the right and y down from the upper left corner, z towards the detector.
   * @param {ArrayLike<number>} points units @param {number} at where its x stands @param {number[]} out
   */
  project(points, at, out) {
    const x = this.scale * (points[at] - this.centre[0]);
    const y = this.scale * (points[at + 1] - this.centre[1]);
    const z = this.scale * (points[at + 2] - this.centre[2]);
    out[0] = 0.5 * this.columns + x * this.right[0] + y * this.right[1] + z * this.right[2];
    out[1] = 0.5 * this.rows - (x * this.up[0] + y * this.up[1] + z * this.up[2]);
    out[2] = x * this.towards[0] + y * this.towards[1] + z * this.towards[2];
    return out;
  }

  /** The point that is seen at x, y and z in pixels. @param {number} x @param {number} y @param {number} z */
  place(x, y, z) {
    const [a, b] = [x - 0.5 * this.columns, 0.5 * this.rows - y];
    return this.centre.map((value, k) => value + (a * this.right[k] + b * this.up[k] + z * this.towards[k]) / this.scale);
  }

  /**
   * The side of a picture in which a box is seen from its middle, units.
   * @param {number} lao @param {number} cranial @param {Point} low corner, units @param {Point} high
   * @param {Patient} patient
   */
  static framing(lao, cranial, low, high, patient = UNKNOWN) {
    const middle = /** @type {Point} */ (low.map((value, k) => 0.5 * (value + high[k])));
    const look = new CArm(lao, cranial, middle, 1, 1, patient);
    let side = 1e-9;
    for (let corner = 0; corner < 8; corner++) {
      const [x, y] = look.project([corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
        corner & 4 ? high[2] : low[2]], 0, [0, 0, 0]);
      side = Math.max(side, 2.1 * Math.abs(x - 0.5), 2.1 * Math.abs(y - 0.5));
    }
    return side;
  }
}
