// @ts-check
import { progress } from "./target.js";
import { fixed, say } from "./words.js";

const PER_CAUTION = 1; // points a second of a wall force in the yellow band
const PER_STOP = 5; // in the red one
const LONGEST = 1; // s between two frames: what was between others is not known
const WITHDRAWN = 5; // mm that the hub goes back where it is one more attempt
const FREE = 0.01; // of the yellow band's force: below it a wire has the shape that it was given
const FOLDED = 0.08; // strain of a fibre that no nitinol takes back

/**
 * Limits of an instrument's gauges, N: where one should look, and where one should stop; null where its stiffness has no
 * unit. At the hub they are half and all of the load at which 50 mm of its shaft bow out between fingers and valve, at a
 * wall once and twice that of its last 10 mm. For training, not for patients.
 * @param {import("./recording.js").Recording} recording @param {number} instrument
 */
export function limitsOf(recording, instrument) {
  const { tipLoad, shaftLoad } = recording.instruments[instrument] ?? {};
  return tipLoad && shaftLoad ? { hub: [0.5 * shaftLoad, shaftLoad], wall: [tipLoad, 2 * tipLoad] } : null;
}

/** @typedef {{time: number, kind: string, text: string}} Mishap */

/**
 * What a run has done, and its score: 100 points for the whole way to the target, less one for each second with a wall
 * force in the yellow band and five for each in the red one. It depends on the frames alone, so that a replay has the same.
 */
export class Score {
  /** @param {import("./recording.js").Recording} recording */
  constructor(recording) {
    this._recording = recording;
    this._limits = limitsOf(recording, 0);
    /** The first frame that does not count yet. */
    this._next = 0;
    /** s. */
    this.time = NaN;
    /** Seconds of a wall force in the yellow band. */
    this.caution = 0;
    /** Seconds in the red one. */
    this.stop = 0;
    /** Largest part of the way that was done. */
    this.best = 0;
    /** Units to the target, now and as the run began. */
    this.left = this.first = NaN;
    /** s. */
    this.reachedAt = NaN;
    /** Largest forces so far, N. */
    this.hubForce = this.wallForce = this.strandForce = 0;
    /** Way of the tip, units. */
    this.path = 0;
    /** How often the wire was withdrawn to try anew. */
    this.retries = 0;
    /** Where the tip and the wire's hub were as the run began, units. @type {number[][]} */
    this.begun = [];
    /** @type {Mishap[]} */
    this.mishaps = [];
    /** Which of them last still. @type {Record<string, boolean>} */
    this._lasting = {};
    /** @type {number[]} */
    this._tip = [];
    this._turned = 0; // m: insertion from which on the wire was advanced or withdrawn last
    this._isWithdrawn = false;
    /** Strains that it has where no wall presses it, as of a bent tip. @type {number[]} */
    this._shape = [];
    this._wasInside = false; // a wire may begin before its vessel
  }

  restart() {
    Object.assign(this, new Score(this._recording));
  }

  /** Points, from 0 to 100. */
  get points() {
    return Math.max(0, Math.round(100 * this.best - PER_CAUTION * this.caution - PER_STOP * this.stop));
  }

  /** What stands when another page goes on with the run. */
  save() {
    const own = ["_recording", "_limits", "_next"];
    return Object.fromEntries(Object.entries(this).filter(([name]) => !own.includes(name)));
  }

  /** Goes on with what another page saved of the same run. @param {any} saved */
  restore(saved) {
    Object.assign(this, Object.fromEntries(Object.entries(saved).map(([key, value]) => [key, value ?? NaN])));
    this._next = this._recording.count - 1;
  }

  /** Takes the frames up to one; from an earlier one it begins anew. @param {number} frame */
  show(frame) {
    if (frame < this._next - 1) this.restart();
    for (; this._next <= frame; this._next++) this._take(this._next);
  }

  /** Whether a frame has counted. @param {number} frame */
  has(frame) {
    return frame < this._next;
  }

  /** As the recording forgets its first frames. @param {number} frames */
  forget(frames) {
    this._next = Math.max(0, this._next - frames);
  }

  /** @param {number} frame */
  _take(frame) {
    const recording = this._recording;
    const time = recording.at("time", frame)[0];
    const since = time - this.time || 0;
    const seconds = since <= LONGEST ? since : 0;
    const force = largestForce(recording, frame);
    const [caution, stop] = this._limits?.wall ?? [Infinity, Infinity];
    if (force >= stop) this.stop += seconds;
    else if (force >= caution) this.caution += seconds;
    this.time = time;
    this.wallForce = Math.max(this.wallForce, force || 0);
    if (recording.channels.has("strandForce")) {
      this.strandForce = recording.at("strandForce", frame).reduce((most, value) => Math.max(most, value),
        this.strandForce);
    }
    const at = (/** @type {string} */ name) => (recording.channels.has(name) ? recording.at(name, frame)[0] : NaN);
    const hub = Math.abs(at("hubForce"));
    this.hubForce = Math.max(this.hubForce, hub || 0);
    this._move(frame, at("hubInsertion"));
    this._note("wall", force >= stop, force < caution, say("wall force of {0}, above {1}", newtons(force), newtons(stop)));
    const most = this._limits?.hub[1] ?? Infinity;
    this._note("hub", hub >= most, hub < 0.9 * most, say("force at the hub of {0}: the shaft bows out", newtons(hub)));
    const strains = strainsOf(recording, frame);
    if (!(force >= FREE * caution)) strains.forEach((value, i) => { this._shape[i] = Math.max(value, this._shape[i] ?? 0); });
    const strain = Math.max(0, ...strains.map((value, i) => value - (this._shape[i] ?? 0)));
    this._note("kink", strain >= FOLDED, strain < 0.5 * FOLDED, say("wire kinked: {0} % strain", fixed(100 * strain, 1)));
    if (!recording.channels.has("lumen")) return;
    const [left, isAt, isInside] = recording.at("lumen", frame);
    this._wasInside ||= isInside > 0;
    this._note("left", this._wasInside && !isInside, isInside > 0, say("the wire has left the vessel"));
    if (Number.isNaN(left)) return;
    if (Number.isNaN(this.first)) this.first = left;
    const done = progress(this.first, [left, isAt]);
    this.left = done.left;
    this.best = Math.max(this.best, done.fraction);
    if (done.isReached && Number.isNaN(this.reachedAt)) this.reachedAt = time;
  }

  /** @param {number} frame @param {number} insertion m */
  _move(frame, insertion) {
    const x = this._recording.at("positions", frame);
    const tip = [...x.subarray(-3)];
    if (!this.begun.length) this.begun = [tip, [...x.subarray(0, 3)]];
    if (this._tip.length) this.path += apart(tip, this._tip);
    this._tip = tip;
    const millimetres = 1000 * (insertion - this._turned);
    if (this._isWithdrawn ? millimetres < 0 : millimetres > 0) this._turned = insertion;
    if (Math.abs(millimetres) < WITHDRAWN || (millimetres < 0) === this._isWithdrawn) return;
    this._isWithdrawn = millimetres < 0;
    this._turned = insertion;
    this.retries += Number(this._isWithdrawn);
  }

  /** @param {string} kind @param {boolean} isOn @param {boolean} isOver @param {string} text */
  _note(kind, isOn, isOver, text) {
    if (isOn && !this._lasting[kind]) this.mishaps.push({ time: this.time, kind, text });
    if (isOn || isOver) this._lasting[kind] = isOn;
  }
}

/**
 * The largest force of a wall on a node of any instrument; NaN where it is not known.
 * @param {import("./recording.js").Recording} recording @param {number} frame
 */
export function largestForce(recording, frame) {
  if (!recording.channels.has("contactForce")) return NaN;
  let most = recording.at("contactForce", frame).reduce((largest, value) => Math.max(largest, value), 0);
  for (const name of recording.channels.keys()) {
    if (!/^contactForces\d+$/.test(name)) continue;
    const forces = recording.at(name, frame);
    for (let i = 0; i < forces.length; i += 3) most = Math.max(most, Math.hypot(...forces.subarray(i, i + 3)));
  }
  return most;
}

/** Strain of a fibre of the wire outside of its sheath, of each element, by its curvature; none where that has no unit.
 * @param {import("./recording.js").Recording} recording @param {number} frame @returns {number[]} */
function strainsOf(recording, frame) {
  const radii = recording.instruments[0]?.radii;
  if (!radii || recording.channels.get("curvature")?.unit !== "rad/m") return [];
  const first = recording.firstShown(frame);
  return Array.from(recording.at("curvature", frame), (curvature, i) =>
    (i < first ? 0 : curvature * 1e-3 * recording.millimetres * radii[Math.min(i, radii.length - 1)]));
}

/** A force as one reads it. @param {number} value N */
export function newtons(value) {
  const size = Math.abs(value);
  const [number, unit] = size < 0.1 ? [1000 * value, "mN"] : [value, "N"];
  const digits = Math.abs(number) < 10 ? (unit === "mN" ? 1 : 2) : 0;
  return `${fixed(Number(number.toFixed(digits)) || 0, digits)} ${unit}`;
}

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
export function apart(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
