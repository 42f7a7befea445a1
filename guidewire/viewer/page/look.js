// @ts-check
import { CArm, UNKNOWN } from "./carm.js";
import { LumenCells } from "./cells.js";
import { Lumen } from "./lumen.js";
import { say } from "./words.js";

/** @typedef {import("./carm.js").Point} Point */

/**
 * @typedef {object} Look
 * @property {number} lao degrees; RAO is negative
 * @property {number} cranial degrees; caudal is negative
 * @property {Point | null} centre units; null: the middle of what is framed
 * @property {number | null} field side of the picture, mm; null: all that is framed
 * @property {"roadmap" | "contrast" | "none" | "injected" | "map"} vessel
 * @property {number} contrast of what fills the vessel, 1/mm
 * @property {number} agent of undiluted agent that was injected, 1/mm
 * @property {number} background
 * @property {number} noise deviation over brightness
 * @property {number} seed
 * @property {boolean} isSubtracted whether the mask is taken away
 * @property {[number, number]} shift of the mask, pixels
 */

const AGENT = 0.23; // 1/mm: iodine of 300 mg/ml at 60 keV

/** @returns {Look} */
export const plainLook = () => ({
  lao: 0, cranial: 0, centre: null, field: null, vessel: "roadmap", contrast: 0.1, agent: AGENT,
  background: 0.75, noise: 0, seed: 0,
  isSubtracted: false, shift: [0, 0],
});
/** Brightness over the background's behind the most of a patient and the least, and how soon it changes with the optical depth. */
const [DARKEST, LIGHTEST, STEEP] = [0.74, 1.1, 4];
/** Pixels of a square picture; others have as many in all. */
export const PIXELS = 512;

/** Brightness over the background's, of what passes the contrast agent. */
const VESSELS = {
  none: () => 1,
  injected: () => 1,
  map: () => 1, // of what was injected, as it was seen
  contrast: (/** @type {number} */ passed) => passed,
  roadmap: (/** @type {number} */ passed) => 1 + 0.3 * (1 - passed),
};

/** What an X-ray picture shows, and from where; subclasses draw it. */
export class View {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.columns = this.rows = 0;
    /** @type {Lumen[]} */
    this._lumens = [];
    /** Of a generic patient, with what it attenuates, 1/unit. @type {[Lumen, number][]} */
    this._bodies = [];
    /** Whether that is drawn. */
    this.showsPatient = true;
    /** Lowest and highest corner of what is framed, units. @type {[Point, Point]} */
    this.box = [[0, 0, 0], [1, 1, 1]];
    this.millimetres = 1; // of a unit
    /** How the patient lies. @type {import("./carm.js").Patient} */
    this.patient = UNKNOWN;
    this.look = plainLook();
    this._seen = this._shown = "";
    /** @type {LumenCells | null} */
    this._cells = null;
    /** Part of the blood in each cell that is contrast agent; null: nothing was injected. @type {Float64Array | null} */
    this.parts = null;
    /** What the brightness shows of it. @type {Float64Array | null} */
    this._partsShown = null;
    this._cellsSeen = "";
    this._agent = new Float64Array(0);
    /** The most agent that each ray has passed while it was seen from here, units. */
    this._peak = new Float64Array(0);
    /** Of the lumen along each ray, units; row by row from above. */
    this._thickness = new Float32Array(0);
    /** Brightness of the patient over the background's. */
    this._shade = new Float64Array(0);
    /** Counts how often walls that give way were moved. */
    this.moves = this._movesShown = this._cellsMoves = 0;
    /** Of the cells in a vessel that moves, units. @type {Float32Array | null} */
    this.middles = null;
    /** Brightness of background and vessel. */
    this._brightness = new Float32Array(0);
  }

  /**
   * Says what is seen.
   * @param {import("./recording.js").Wall[]} walls @param {[Point, Point]} box what is framed, units
   * @param {number} millimetres of a unit @param {import("./carm.js").Patient | null} [patient] null: unknown
   * @param {{middles: number[], radii: number[]} | null} [cells] of the vessel's tree, units
   * @param {import("./patient.js").Part[]} [body] of a generic patient
   */
  set(walls, box, millimetres, patient = null, cells = null, body = []) {
    this._bodies = body.map(({ vertices, triangles, attenuation }) => [new Lumen({ isStill: true,
      vertices: Float32Array.from(vertices), triangles: Uint32Array.from(triangles) }), attenuation * millimetres]);
    this._cells = cells && new LumenCells(cells, box);
    this.parts = null;
    this.patient = patient ?? UNKNOWN;
    this._lumens = walls.filter((wall) => wall.kind === "vessel").map((wall) => new Lumen(wall));
    this.box = box;
    this.millimetres = millimetres;
    this._seen = this._shown = this._cellsSeen = "";
  }

  /** @param {number} columns of pixels @param {number} rows @returns {boolean} whether that is another size */
  resize(columns, rows) {
    if (columns === this.columns && rows === this.rows) return false;
    [this.columns, this.rows, this.canvas.width, this.canvas.height] = [columns, rows, columns, rows];
    this._thickness = new Float32Array(columns * rows);
    this._brightness = new Float32Array(columns * rows);
    this._shade = new Float64Array(columns * rows);
    this._agent = new Float64Array(columns * rows);
    this._peak = new Float64Array(columns * rows);
    this._seen = this._shown = this._cellsSeen = "";
    return true;
  }

  /** Takes the shape of a pane. @param {HTMLElement} pane @returns {boolean} whether that is another size */
  fit({ clientWidth: width, clientHeight: height }) {
    if (!width || !height) return false;
    const shape = Math.sqrt(width / height);
    return this.resize(Math.round(PIXELS * shape), Math.round(PIXELS / shape));
  }

  /** The C-arm's angles, as texts. */
  get angles() {
    const { lao, cranial } = this.look;
    const [turned, tilted] = this.patient === UNKNOWN ? [["left", "right"], ["above", "below"]]
      : [["LAO", "RAO"], ["CRAN", "CAUD"]];
    const text = (/** @type {number} */ value, /** @type {string[]} */ names) =>
      `${say(names[value < 0 ? 1 : 0])} ${Math.abs(Math.round(value))}°`;
    return [text(lao, turned), text(cranial, tilted)];
  }

  /** Where it is seen from. */
  get arm() {
    const { lao, cranial, centre, field } = this.look;
    const [low, high] = this.box;
    const middle = centre ?? /** @type {Point} */ (low.map((value, k) => 0.5 * (value + high[k])));
    const side = field === null ? CArm.framing(lao, cranial, low, high, this.patient) : field / this.millimetres;
    return new CArm(lao, cranial, middle, side, this.columns, this.patient, this.rows);
  }

  /** Computes the brightness of background and vessel where they are seen anew or otherwise. @param {CArm} arm
   * @returns {boolean} whether it has changed */
  _setBrightness(arm) {
    const { lao, cranial, vessel, contrast, background } = this.look;
    const seen = [lao, cranial, ...arm.centre, arm.scale, this.showsPatient].join();
    if (seen !== this._seen) this._setShade(arm);
    if (seen !== this._seen || this.moves !== this._movesShown) {
      this._thickness.fill(0);
      for (const lumen of this._lumens) lumen.add(arm, this._thickness);
    }
    const isFilled = this.parts !== null && this._cells !== null;
    this._movesShown = this.moves;
    const shown = [seen, this.moves, vessel, contrast, background].join();
    if (shown === this._shown && this.parts === this._partsShown) return false;
    this._seen = seen;
    this._shown = shown;
    this._partsShown = this.parts;
    const factor = VESSELS[vessel];
    const attenuation = contrast * this.millimetres;
    const { _brightness: brightness, _thickness: thickness } = this;
    for (let i = 0; i < brightness.length; i++) {
      brightness[i] = background * this._shade[i] * factor(Math.exp(-attenuation * thickness[i]));
    }
    if (isFilled) this._fill(arm, seen);
    if (vessel === "map") this._map(seen);
    return true;
  }

  /** Exposes for the patient, within bounds, so that instruments and road maps stay easy to see. @param {CArm} arm */
  _setShade(arm) {
    const { _shade: shade } = this;
    if (!this._bodies.length || !this.showsPatient) {
      shade.fill(1);
      return;
    }
    shade.fill(0);
    for (const [body, attenuation] of this._bodies) body.sum(arm, shade, attenuation / arm.scale);
    const mean = shade.reduce((sum, depth) => sum + depth, 0) / shade.length;
    for (let i = 0; i < shade.length; i++) shade[i] = DARKEST + (LIGHTEST - DARKEST) / (1 + Math.exp(STEEP * (shade[i] - mean)));
  }

  /** As a road map, brightens what was filled with agent at its most. @param {string} seen */
  _map(seen) {
    if (seen !== this._cellsSeen) return;
    const attenuation = this.look.agent * this.millimetres;
    for (let i = 0; i < this._peak.length; i++) {
      if (this._peak[i] > 0) this._brightness[i] *= VESSELS.roadmap(Math.exp(-attenuation * this._peak[i]));
    }
  }

  /** Whether there is a road map of what was injected, seen from here. */
  get hasMap() {
    return this._cellsSeen === this._seen && this._peak.some((value) => value > 0);
  }

  /** Darkens by the agent. @param {CArm} arm @param {string} seen */
  _fill(arm, seen) {
    if (!this._cells || !this.parts) return;
    if (seen !== this._cellsSeen) this._peak.fill(0);
    if (seen !== this._cellsSeen || this.moves !== this._cellsMoves) this._cells.look(arm, this._lumens, this.middles);
    [this._cellsSeen, this._cellsMoves] = [seen, this.moves];
    this._cells.sum(this.parts, this._agent);
    for (let i = 0; i < this._agent.length; i++) {
      if (this._agent[i] > this._peak[i]) this._peak[i] = this._agent[i];
    }
    if (this.look.vessel === "map") return; // the map takes the agent's place
    const attenuation = this.look.agent * this.millimetres;
    for (let i = 0; i < this._agent.length; i++) {
      if (this._agent[i] > 0) this._brightness[i] *= Math.exp(-attenuation * this._agent[i]);
    }
  }
}
