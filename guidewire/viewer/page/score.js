// @ts-check
import { progress } from "./target.js";

/** Limits of the gauges, N: where one should look, and where one should stop. For training, not for patients. */
export const LIMITS = { hubForce: [1, 2], wallForce: [0.5, 1] };
const PER_CAUTION = 1; // points a second of a wall force in the yellow band
const PER_STOP = 5; // in the red one

/**
 * The score of a run: 100 points for the whole route to the target, less one for each second with a wall force in the
 * yellow band and five for each in the red one. It depends on the frames alone, so that a replay has the same.
 */
export class Score {
  /** @param {import("./recording.js").Recording} recording */
  constructor(recording) {
    this._recording = recording;
    /** The first frame that does not count yet. */
    this._next = 0;
    this._time = NaN;
    /** Seconds of a wall force in the yellow band. */
    this.caution = 0;
    /** Seconds in the red one. */
    this.stop = 0;
    /** Largest part of the route that was done. */
    this.best = 0;
    /** Units to the target. */
    this.left = NaN;
    /** s. */
    this.reachedAt = NaN;
  }

  restart() {
    Object.assign(this, new Score(this._recording));
  }

  /** Points, from 0 to 100. */
  get points() {
    return Math.max(0, Math.round(100 * this.best - PER_CAUTION * this.caution - PER_STOP * this.stop));
  }

  /** Takes the frames up to one; from an earlier one it begins anew. @param {number} frame */
  show(frame) {
    if (frame < this._next - 1) this.restart();
    const route = this._recording.described?.target;
    for (; this._next <= frame; this._next++) {
      const time = this._recording.at("time", this._next)[0];
      const seconds = time - this._time || 0;
      const force = largestForce(this._recording, this._next);
      if (force >= LIMITS.wallForce[1]) this.stop += seconds;
      else if (force >= LIMITS.wallForce[0]) this.caution += seconds;
      this._time = time;
      if (!route || !this._recording.channels.has("lumen")) continue;
      const { left, fraction, isReached } = progress(route, this._recording.at("lumen", this._next));
      this.left = left;
      this.best = Math.max(this.best, fraction);
      if (isReached && Number.isNaN(this.reachedAt)) this.reachedAt = time;
    }
  }

  /** As the recording forgets its first frames. @param {number} frames */
  forget(frames) {
    this._next = Math.max(0, this._next - frames);
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
