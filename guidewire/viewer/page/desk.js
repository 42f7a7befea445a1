// @ts-check
import { Dial, Gauge } from "./gauges.js";
import { byId, make } from "./panel.js";
import { LIMITS, Score, largestForce } from "./score.js";

/** @typedef {import("./recording.js").Recording} Recording */

const MILLIMETRES_A_TURN = 100; // of the dial of insertion

/** What an operator looks at beside the pictures: forces, insertion and turn, the target, the instruments. */
export class Desk {
  constructor() {
    /** @type {Recording | null} */
    this._recording = null;
    this._peaks = { hub: 0, wall: 0 };
    this._held = 0; // instrument whose hub is read off
    this._first = 0; // z of the first node along the drive, where nothing is read off at the hub
  }

  /** @param {Recording[]} recordings the first one is read off */
  set(recordings) {
    const [recording] = recordings;
    this._recording = recording;
    this.score = new Score(recording);
    const hub = recording.channels.get("hubForce");
    const wall = recording.channels.get("contactForce");
    this._hub = new Gauge("force at the hub", hub?.unit === "N" ? LIMITS.hubForce : null);
    this._wall = new Gauge("largest wall force", wall?.unit === "N" ? LIMITS.wallForce : null);
    this._insertion = new Dial("insertion", (millimetres) => (2 * Math.PI * millimetres) / MILLIMETRES_A_TURN);
    this._turn = new Dial("turn", (turn) => turn);
    const target = recording.described?.target;
    this._left = make("output", {});
    this._routeDone = make("i", {});
    const card = make("div", { className: "card" },
      ...(target ? [make("div", { className: "line" }, make("span", {}, `to ${target.name}`), this._left),
        make("div", { className: "route" }, this._routeDone)]
        : [make("div", { className: "line" }, make("span", {}, "tip went"), this._left)]));
    this._legend = make("div", { className: "card", id: "legend" }, ...recordings.flatMap((one) =>
      one.instruments.map((instrument) => make("div", {}, swatch(instrument.colour),
        recordings.length > 1 ? `${instrument.name}, ${one.title}` : instrument.name))));
    byId("desk").replaceChildren(this._hub.element, this._wall.element,
      make("div", { className: "dials" }, this._insertion.element, this._turn.element), card, this._legend);
    byId("scoreReading").hidden = !target;
  }

  /** Reads off at the hub of another instrument. @param {number} instrument which the hand holds; -1: none */
  hold(instrument) {
    this._held = Math.max(instrument, 0);
    [...(this._legend?.children ?? [])].forEach((line, k) =>
      line.classList.toggle("held", k === instrument && this._legend.children.length > 1));
  }

  /** Shows a frame. @param {number} frame */
  show(frame) {
    const recording = this._recording;
    if (!recording || !this.score) return;
    const hub = this._held && recording.channels.has(`hub${this._held}Force`) ? `hub${this._held}` : "hub";
    this.score.show(frame);
    const at = (/** @type {string} */ name) =>
      (recording.channels.has(name) ? recording.at(name, frame)[0] : NaN);
    const unitOf = (/** @type {string} */ name) => recording.channels.get(name)?.unit ?? "";
    this._hub?.show(at(`${hub}Force`), unitOf(`${hub}Force`), recording.channels.get(`${hub}Force`)?.largest ?? 0);
    this._wall?.show(largestForce(recording, frame), unitOf("contactForce"),
      recording.channels.get("contactForce")?.largest ?? 0);
    const millimetres = recording.millimetres;
    const inserted = recording.channels.has(`${hub}Insertion`) ? 1000 * at(`${hub}Insertion`)
      : millimetres * moved(recording, frame, 0);
    this._insertion?.show(inserted, `${inserted.toFixed(1)}\nmm`);
    const turn = at(`${hub}Turn`);
    this._turn?.show(turn, `${Math.round((turn * 180) / Math.PI)}°`);
    const clock = byId("clock");
    clock.textContent = `${at("time").toFixed(1)} s`;
    byId("score").textContent = String(this.score.points);
    if (!this._left || !this._routeDone) return;
    if (recording.described?.target) {
      const { left, reachedAt, best } = this.score;
      this._left.textContent = Number.isNaN(reachedAt) ? `${(millimetres * left).toFixed(0)} mm`
        : `reached at ${reachedAt.toFixed(1)} s`;
      this._routeDone.style.width = `${100 * best}%`;
    } else {
      const spheres = recording.channel("positions").width / 3;
      this._left.textContent = `${(millimetres * moved(recording, frame, spheres - 1)).toFixed(0)} mm`;
    }
  }
}

/**
 * How far a node is from where the recording begins, units.
 * @param {Recording} recording @param {number} frame @param {number} node
 */
function moved(recording, frame, node) {
  const from = recording.at("positions", 0).subarray(3 * node, 3 * node + 3);
  const to = recording.at("positions", frame).subarray(3 * node, 3 * node + 3);
  return Math.hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
}

/** @param {string} colour */
function swatch(colour) {
  const made = make("span", { className: "swatch" });
  made.style.background = colour;
  return made;
}
