// @ts-check
import { BufferAttribute, BufferGeometry, DynamicDrawUsage } from "three";

const PER_ELEMENT = 4; // rings
const SIDES = 12; // corners of a ring
const CAP = 4; // rings of a round end

/**
 * The surface of a wire: rings around a cubic through all spheres whose slope at sphere i is (x_{i+1} - x_{i-1})/2, as
 * guidewire/logs/surfaces.py and the Unity scene draw it, with round ends.
 */
export class Tube {
  /** @param {number} elements number of rod elements */
  constructor(elements) {
    this.elements = elements;
    this.rings = elements * PER_ELEMENT + 1 + 2 * CAP;
    const vertices = this.rings * SIDES;
    this.geometry = new BufferGeometry();
    for (const name of ["position", "normal", "color"]) {
      const attribute = new BufferAttribute(new Float32Array(3 * vertices), 3);
      attribute.setUsage(DynamicDrawUsage);
      this.geometry.setAttribute(name, attribute);
    }
    const triangles = [];
    for (let a = 0; a < vertices - SIDES; a++) {
      const b = a % SIDES === SIDES - 1 ? a + 1 - SIDES : a + 1;
      triangles.push(a, b, a + SIDES, b, b + SIDES, a + SIDES);
    }
    this.geometry.setIndex(triangles);
    this._first = 0; // ring that is drawn
    this._centre = new Float64Array(3);
    this._tangent = new Float64Array(3);
  }

  /**
   * Lays it along the spheres.
   * @param {Float64Array} x x, y, z of each sphere, units
   * @param {number} radius units
   * @param {number} first element from which on it is drawn
   */
  place(x, radius, first) {
    const position = this.geometry.getAttribute("position").array;
    const normals = this.geometry.getAttribute("normal").array;
    const normal = [0, 0, 0];
    this._first = first > 0 ? CAP + Math.min(first, this.elements - 1) * PER_ELEMENT : 0;
    this.geometry.setDrawRange(6 * SIDES * this._first, Infinity);
    for (let ring = this._first; ring < this.rings; ring++) {
      // At the ends rings grow smaller: a quarter of a circle, seen from the side.
      const beyond = Math.max(CAP - ring, ring - (this.rings - 1 - CAP), 0);
      const angle = (beyond / CAP) * 0.5 * Math.PI;
      const sign = ring < CAP ? -1 : 1;
      this._point(x, Math.min(Math.max(ring - CAP, 0), this.elements * PER_ELEMENT) / PER_ELEMENT);
      const [tx, ty, tz] = this._tangent;
      if (ring === this._first) {
        const [ax, ay] = Math.abs(tx) < 0.9 ? [1, 0] : [0, 1];
        normal[0] = -tz * ay;
        normal[1] = tz * ax;
        normal[2] = tx * ay - ty * ax;
      }
      const along = normal[0] * tx + normal[1] * ty + normal[2] * tz;
      normal[0] -= along * tx;
      normal[1] -= along * ty;
      normal[2] -= along * tz;
      const size = Math.hypot(normal[0], normal[1], normal[2]) || 1;
      const [nx, ny, nz] = [normal[0] / size, normal[1] / size, normal[2] / size];
      [normal[0], normal[1], normal[2]] = [nx, ny, nz];
      const [bx, by, bz] = [ty * nz - tz * ny, tz * nx - tx * nz, tx * ny - ty * nx];
      const [outward, forward] = [Math.cos(angle), sign * Math.sin(angle)];
      for (let side = 0; side < SIDES; side++) {
        const cos = Math.cos((2 * Math.PI * side) / SIDES) * outward;
        const sin = Math.sin((2 * Math.PI * side) / SIDES) * outward;
        const k = 3 * (ring * SIDES + side);
        normals[k] = cos * nx + sin * bx + forward * tx;
        normals[k + 1] = cos * ny + sin * by + forward * ty;
        normals[k + 2] = cos * nz + sin * bz + forward * tz;
        for (let part = 0; part < 3; part++) position[k + part] = this._centre[part] + radius * normals[k + part];
      }
    }
    this.geometry.getAttribute("position").needsUpdate = true;
    this.geometry.getAttribute("normal").needsUpdate = true;
  }

  /**
   * Gives each ring a colour.
   * @param {(along: number, colour: number[]) => void} colourAt writes red, green and blue of a place along the wire,
   *     counted in elements
   */
  paint(colourAt) {
    const colours = this.geometry.getAttribute("color").array;
    const colour = [0, 0, 0];
    for (let ring = this._first; ring < this.rings; ring++) {
      colourAt(Math.min(Math.max(ring - CAP, 0), this.elements * PER_ELEMENT) / PER_ELEMENT, colour);
      for (let k = 3 * ring * SIDES; k < 3 * (ring + 1) * SIDES; k += 3) {
        colours[k] = colour[0];
        colours[k + 1] = colour[1];
        colours[k + 2] = colour[2];
      }
    }
    this.geometry.getAttribute("color").needsUpdate = true;
  }

  /** Puts place and direction of the curve into `_centre` and `_tangent`. @param {Float64Array} x @param {number} at */
  _point(x, at) {
    const last = this.elements;
    const j = Math.min(Math.floor(at), last - 1);
    const t = at - j;
    const s = 1 - t;
    let size = 0;
    for (let part = 0; part < 3; part++) {
      const a = x[3 * j + part];
      const b = x[3 * j + 3 + part];
      const before = j > 0 ? 0.5 * (b - x[3 * j - 3 + part]) : b - a;
      const after = j + 2 <= last ? 0.5 * (x[3 * j + 6 + part] - a) : b - a;
      this._centre[part] = s * s * (1 + 2 * t) * a + t * t * (3 - 2 * t) * b + t * s * s * before - t * t * s * after;
      this._tangent[part] = 6 * t * s * (b - a) + s * (1 - 3 * t) * before + t * (3 * t - 2) * after;
      size += this._tangent[part] ** 2;
    }
    size = Math.sqrt(size) || 1;
    for (let part = 0; part < 3; part++) this._tangent[part] /= size;
  }
}
