// @ts-check
import {
  BufferAttribute, BufferGeometry, Color, CylinderGeometry, DoubleSide, Group, Line, LineBasicMaterial, LineSegments, Mesh,
  MeshLambertMaterial, Sprite, Vector2, Vector3,
} from "three";

import { ramp, roundUp, row } from "./colours.js";
import { DrawnInstrument } from "./instrument.js";
import { throughTips } from "./path.js";
import { SHAPE } from "./report.js";
import { glow, rimOfLight, ringAt, tissue } from "./tissue.js";

/** @typedef {import("./recording.js").Recording} Recording */

/** Layer of walls behind the wire, and of those that tint it. */
export const [BEHIND, BEFORE] = [1, 2];
const [STEEL, GOLD] = ["#dfe7ee", "#ffb84a"].map((colour) => new Color(colour)); // of a wire that is not coloured, and of its tip
const TIP = 20; // mm of it
const FOLD = 6; // mm of a vessel's wall that has one fold
const GLOW = 30; // points of the screen, at least
/** Of a patient. @type {Record<string, import("three").Material>} */
const RIMS = { skin: rimOfLight(new Color(0.53, 0.66, 0.78), 0.5, 3.2), bone: rimOfLight(new Color(0.53, 0.66, 0.78), 0.55, 1.5) };
const VIOLET = [0.72, 0.55, 1]; // of a ghost
const ARROWS = 0x7fe07f;
const LONGEST_ARROW = 0.2; // fraction of the wire's length
const LEAST_RADIUS = 2.5; // points of the screen that a wire takes so that it is seen
const SHEATH_COLOUR = 0x8fa9c4;
const SHEATH = 2; // radius of a sheath over that of the widest instrument in it

/** One run in the picture: its instruments, walls and the forces of the walls on it. */
export class Model {
  /** @param {Recording} recording */
  constructor(recording) {
    this.recording = recording;
    this.group = new Group();
    this.walls = new Group();
    const spheres = recording.channel("positions").width / 3;
    /** What tints the wire: walls before it, of the pane that it is in. */
    this.tint = { before: { value: /** @type {import("three").Texture | null} */ (null) },
      origin: { value: new Vector2() } };
    /** The wire, and then the catheters over it. */
    this.drawn = recording.centrelines.map((name, k) => new DrawnInstrument(recording.channel(name).width / 3
      + (k === 0 ? recording.centrelines.length - 1 : 0), k > 0, (material) => this._tinted(material)));
    /** Lengths of the wire's elements: the longest that were seen. */
    this._lengths = new Float64Array(spheres - 1);
    /** Of each point that the wire is drawn by, where it is along the wire, in elements. @type {number[]} */
    this._along = [];
    this.arrows = new LineSegments(new BufferGeometry(), this._tinted(new LineBasicMaterial({ color: ARROWS })));
    this.arrows.geometry.setAttribute("position", new BufferAttribute(new Float32Array(6 * spheres), 3));
    this.arrows.frustumCulled = false;
    const { target } = recording.described ?? {};
    this._glow = glow(0xffa03c);
    this._ghost = new DrawnInstrument(SHAPE, false, (material) => this._tinted(material));
    this._ghost.group.visible = false;
    this._ring = target && ringAt(target);
    if (this._ring) this.group.add(this._ring);
    for (const wall of recording.walls) this.walls.add(...surfaces(wall, recording.millimetres));
    this.patient = new Group();
    for (const part of recording.body.filter(({ kind }) => kind in RIMS)) this.patient.add(rim(part));
    this._moves = 0; // of walls, that are in the picture
    this.group.add(...this.drawn.map((one) => one.group), this.arrows, this.walls, this.patient, this._glow, this._ghost.group);
    this._sheath = recording.sheath && makeSheath(recording.sheath, SHEATH * Math.max(
      ...recording.centrelines.map((_, k) => recording.radiusOf(k))), [
      this._tinted(new MeshLambertMaterial({ color: SHEATH_COLOUR })),
      this._tinted(new LineBasicMaterial({ color: SHEATH_COLOUR }))]);
    if (this._sheath) this.group.add(this._sheath);
    /** Whether it takes its instrument's colour where no channel colours it: it lies over another run. */
    this.isPlain = false;
    /** Name of the channel that colours the wire; "" for none. */
    this.colour = "";
    /** How many times thicker than it is the wire is drawn; null: as much as it takes to be seen. @type {number | null} */
    this.thickness = null;
    /** Units of a point of the screen, where the camera looks. */
    this.unitsPerPoint = 0;
    this.frame = 0;
    /** Instrument whose tip pictures keep in view. */
    this.watched = 0;
    this._drawnThickness = 1;
    /** @type {number | undefined} */
    this._shared = undefined;
    this._ramps = [ramp(false), ramp(true)];
  }

  /**
   * Lets walls before the wire tint it: their colours, with alpha in them, lie over its own.
   * @template {import("three").Material} T @param {T} material @returns {T}
   */
  _tinted(material) {
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.tint);
      shader.fragmentShader = `uniform lowp sampler2D before;
uniform vec2 origin;
${shader.fragmentShader.replace("#include <dithering_fragment>", `#include <dithering_fragment>
lowp vec4 tint = texelFetch(before, ivec2(gl_FragCoord.xy - origin), 0);
gl_FragColor.rgb = gl_FragColor.rgb * (1.0 - tint.a) + tint.rgb;`)}`;
    };
    return material;
  }

  /** The value that full red stands for; grows with a run that goes on. 0: all is zero. @param {string} name of a
   * channel */
  full(name) {
    return roundUp(this.recording.channel(name).largest);
  }

  /** Shows a frame. @param {number} frame @param {number} [full] value of full red, where two share a scale */
  show(frame, full) {
    this.frame = frame;
    this._shared = full;
    const positions = this.recording.at("positions", frame);
    const first = this.recording.firstShown(frame);
    this.recording.moveWalls(frame);
    this._ring?.position.fromArray(this.recording.targetAt(frame));
    if (this.recording.moves !== this._moves) {
      this._moves = this.recording.moves;
      for (const part of this.walls.children) {
        if (part instanceof Mesh) part.geometry.getAttribute("position").needsUpdate = true;
      }
    }
    this._drawnThickness = this.shownThickness;
    const path = this.wirePath();
    this._along = path.along;
    this.drawn.forEach((one, k) => one.place(k === 0 ? path.points : this.centreline(k),
      this.recording.radiusOf(k) * this._drawnThickness,
      k === 0 ? path.along.findIndex((place) => place >= first) : 0));
    this._sheath?.children[0].scale.set(this._drawnThickness, 1, this._drawnThickness);
    this._glow.position.fromArray(this.watchedTip);
    this._glow.scale.setScalar(Math.max(5 * this.recording.radius * this._drawnThickness, GLOW * this.unitsPerPoint));
    this._paint(full);
    this._point(positions, first);
  }

  /** Shows where another wire was at this moment, or none. @param {number[]} [points] units */
  showGhost(points) {
    this._ghost.group.visible = points !== undefined;
    if (!points) return;
    this._ghost.place(Float64Array.from(points), this.recording.radius * this._drawnThickness, 0);
    this._ghost.paint((_, colour) => colour.splice(0, 3, ...VIOLET));
  }

  /** How many times its radius the wire's drawn one is. */
  get shownThickness() {
    return this.thickness ?? Math.max(1, (LEAST_RADIUS * this.unitsPerPoint) / this.recording.radius);
  }

  /** Takes what a point of the screen is now. @param {number} units @returns {boolean} whether the wire is drawn in
   * another thickness now */
  takeScale(units) {
    this.unitsPerPoint = units;
    const isOther = Math.abs(this.shownThickness / this._drawnThickness - 1) > 0.05;
    if (isOther) this.show(this.frame, this._shared);
    return isOther;
  }

  /** The points of an instrument's centreline in the frame shown. @param {number} instrument its number */
  centreline(instrument) {
    return this.recording.at(this.recording.centrelines[instrument], this.frame);
  }

  /** The points that the wire is drawn by in the frame shown: tips that it comes out of among them. */
  wirePath() {
    const [wire, ...catheters] = this.recording.centrelines.map((_, k) => this.centreline(k));
    return throughTips(wire, catheters, this._lengthsWith(wire));
  }

  /** The wire for X-rays, and its points. @param {import("./pieces.js").Instrument} wire
   * @returns {[import("./pieces.js").Instrument, Float64Array]} */
  imagedWire(wire) {
    const { points, along } = this.wirePath();
    const of = (/** @type {number[]} */ values) => along.slice(0, -1).map((place) => values[Math.floor(place)]);
    return [{ ...wire, radii: of(wire.radii), innerRadii: of(wire.innerRadii), attenuations: of(wire.attenuations),
      bands: [] }, points];
  }

  /** The place of the wire's last sphere, units. */
  get tip() {
    return this.centreline(0).slice(-3);
  }

  /** The place that pictures keep in view, units: the tip of the held instrument. */
  get watchedTip() {
    return this.centreline(this.watched).slice(-3);
  }

  /** Lets go of what the picture's memory holds of it. */
  dispose() {
    this.group.traverse((part) => {
      if (!(part instanceof Mesh || part instanceof Line || part instanceof Sprite)) return;
      if (!(part instanceof Sprite)) part.geometry.dispose(); // which all of them share
      part.material.dispose();
    });
  }

  /** @param {number} [shared] */
  _paint(shared) {
    const channel = this.colour ? this.recording.channels.get(this.colour) : undefined;
    const [wire] = this.drawn;
    this.drawn.slice(1).forEach((one) => {
      const { r, g, b } = new Color(this.recording.instruments[this.drawn.indexOf(one)]?.colour);
      one.paint((_, colour) => colour.splice(0, 3, r, g, b));
    });
    if (!channel) {
      let [from, left] = [this._lengths.length, TIP / this.recording.millimetres];
      while (from > 0 && left > 0) left -= this._lengths[--from];
      const last = this._along.length - 1;
      const body = this.isPlain ? new Color(this.recording.instruments[0]?.colour ?? GOLD) : STEEL;
      wire.paint((point, colour) => {
        const { r, g, b } = this._along[Math.min(Math.floor(point), last)] >= from ? GOLD : body;
        colour.splice(0, 3, r, g, b);
      });
      return;
    }
    const values = this.recording.at(channel.name, this.frame);
    const full = shared ?? this.full(channel.name);
    const colours = this._ramps[channel.isSigned ? 1 : 0];
    const last = values.length - 1;
    wire.paint((point, colour) => {
      const from = Math.min(Math.floor(point), this._along.length - 2);
      const along = this._along[from] + (point - from) * (this._along[from + 1] - this._along[from]);
      const j = Math.min(Math.floor(along), last);
      const next = channel.place === "sphere" ? values[Math.min(j + 1, last)] : values[j];
      const k = 3 * row(values[j] + (along - j) * (next - values[j]), full, channel.isSigned);
      for (let part = 0; part < 3; part++) colour[part] = colours[k + part];
    });
  }

  /** @param {Float64Array} positions @param {number} first sphere that is shown */
  _point(positions, first) {
    const channel = this.recording.channels.get("contactForces");
    const ends = this.arrows.geometry.getAttribute("position");
    if (!channel) {
      this.arrows.geometry.setDrawRange(0, 0);
      return;
    }
    const forces = this.recording.at("contactForces", this.frame);
    const unit = (LONGEST_ARROW * this._length(positions.subarray(3 * first)))
      / (this.full("contactForces") || 1);
    for (let i = 0; i < positions.length; i += 3) {
      for (let part = 0; part < 3; part++) {
        ends.array[2 * i + part] = positions[i + part];
        ends.array[2 * i + 3 + part] = positions[i + part] + unit * forces[i + part];
      }
    }
    ends.needsUpdate = true;
  }

  /** Lengths of the wire's elements, those of a frame taken in: in a catheter chords are shorter.
   * @param {Float64Array} x of its spheres */
  _lengthsWith(x) {
    for (let j = 0; j < this._lengths.length; j++) {
      this._lengths[j] = Math.max(this._lengths[j], this._length(x.subarray(3 * j, 3 * j + 6)) || 0);
    }
    return this._lengths;
  }

  /** @param {Float64Array} x */
  _length(x) {
    let length = 0;
    for (let i = 3; i < x.length; i += 3) {
      length += Math.hypot(x[i] - x[i - 3], x[i + 1] - x[i - 2], x[i + 2] - x[i - 1]);
    }
    return length;
  }
}

/**
 * The part of a sheath that a wire begins in: a tube, and a line where that is thinner than a point of the screen.
 * @param {[number[], number[]]} ends @param {number} radius units
 * @param {[MeshLambertMaterial, LineBasicMaterial]} looks
 */
function makeSheath(ends, radius, [surface, stroke]) {
  const [exit, back] = ends.map((end) => new Vector3().fromArray(end));
  const along = exit.clone().sub(back);
  const tube = new Mesh(new CylinderGeometry(radius, radius, along.length(), 24), surface);
  tube.position.copy(exit).add(back).multiplyScalar(0.5);
  tube.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), along.normalize());
  return new Group().add(tube, new Line(new BufferGeometry().setFromPoints([back, exit]), stroke));
}

/** What of a patient is seen from outside, as rims of light. @param {import("./patient.js").Part} part */
function rim({ kind, vertices, triangles }) {
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(Float32Array.from(vertices), 3)).setIndex(triangles);
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, RIMS[kind]);
  mesh.layers.set(BEHIND);
  return mesh;
}

/** A wall as one looks into it: its far side, and its near side faintly. @param {import("./recording.js").Wall} wall
 * @param {number} millimetres of a unit */
function surfaces(wall, millimetres) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(wall.vertices, 3));
  geometry.setIndex(new BufferAttribute(wall.triangles, 1));
  geometry.computeVertexNormals();
  const parts = (wall.kind === "obstacle" ? [new MeshLambertMaterial({ transparent: true, depthWrite: false, color: 0x7399bf, opacity: 0.35,
    side: DoubleSide })] : [tissue(false, FOLD / millimetres), tissue(true, FOLD / millimetres)])
    .map((look) => new Mesh(geometry, look));
  parts.forEach((part, k) => part.layers.set(k === 0 ? BEFORE : BEHIND));
  return parts;
}
