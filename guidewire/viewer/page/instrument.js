// @ts-check
import { BufferAttribute, BufferGeometry, Group, Line, LineBasicMaterial, Mesh } from "three";

import { metal } from "./tissue.js";
import { Tube } from "./tube.js";

const OPACITY = 0.55; // opacity of a catheter: one sees what is inside

/** A wire or a catheter in the picture: a tube, and a line where that is thinner than a point of the screen. */
export class DrawnInstrument {
  /**
   * @param {number} spheres of its centreline @param {boolean} isCatheter whether others are inside
   * @param {<T extends import("three").Material>(material: T) => T} tinted lets walls before it tint it
   */
  constructor(spheres, isCatheter, tinted) {
    this.spheres = spheres;
    this.tube = new Tube(spheres - 1);
    const look = isCatheter ? { transparent: true, opacity: OPACITY } : {};
    this._surface = new Mesh(this.tube.geometry, tinted(metal(look)));
    this._line = new Line(new BufferGeometry(), tinted(new LineBasicMaterial({ vertexColors: true, ...look })));
    for (const name of ["position", "color"]) {
      this._line.geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * spheres), 3));
    }
    this._surface.frustumCulled = this._line.frustumCulled = false;
    this.group = new Group().add(this._surface, this._line);
  }

  /** Lays it along its centreline. @param {Float64Array} x x, y, z of each sphere @param {number} radius units
   * @param {number} first sphere from which on it is drawn */
  place(x, radius, first) {
    this.tube.place(x, radius, first);
    this._line.geometry.setDrawRange(first, Infinity);
    const points = this._line.geometry.getAttribute("position");
    points.array.set(x);
    points.needsUpdate = true;
  }

  /** @param {(along: number, colour: number[]) => void} colourAt as of `Tube.paint` */
  paint(colourAt) {
    this.tube.paint(colourAt);
    const colours = this._line.geometry.getAttribute("color");
    const colour = [0, 0, 0];
    for (let i = 0; i < this.spheres; i++) {
      colourAt(i, colour);
      colours.array.set(colour, 3 * i);
    }
    colours.needsUpdate = true;
  }
}
