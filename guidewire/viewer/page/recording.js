// @ts-check
/**
 * What a run left, or leaves while it goes on: numbers by frame, and walls. One block of bytes holds it, as
 * guidewire/viewer/recording.py writes it: the length of the header (4 bytes, lowest first), the header (JSON), the arrays.
 *
 * @typedef {object} Channel numbers of one kind, `width` of them a frame
 * @property {string} name
 * @property {string} label
 * @property {string} unit
 * @property {"frame" | "sphere" | "element" | "vector"} place where they stand: one a frame, at each sphere, at each
 *     rod element, or three at each sphere or element
 * @property {boolean} isSigned whether values below zero mean another direction
 * @property {number} width
 * @property {number} largest size of its numbers so far, what is in a sheath left out
 * @property {Float64Array} values frame after frame
 *
 * @typedef {object} Wall
 * @property {string} kind "vessel" or "obstacle"
 * @property {boolean} isSoft whether it gives way
 * @property {boolean} [isStill] whether it neither gives way nor moves
 * @property {Float32Array} vertices x, y, z each, units; where it gives way, as they are drawn now
 * @property {Uint32Array} triangles three indices each
 *
 * @typedef {object} Recorded
 * @property {string} title
 * @property {string} outcome
 * @property {string[]} warnings
 * @property {[string, string][]} facts
 * @property {number} radius of the wire, units
 * @property {Channel[]} channels
 * @property {Wall[]} walls
 * @property {[number[], number[]] | null} sheath where it ends, and where it is seen to begin, units
 * @property {{millimetresPerUnit: number, target: import("./target.js").Route | null,
 *     cells: {middles: number[], radii: number[]} | null,
 *     patient: import("./carm.js").Patient | null, motions?: import("./moving.js").Cycle[][],
 *     instruments: (import("./pieces.js").Instrument & {title: string})[]} | null} described what pictures need to know
 *
 * @typedef {object} Packed where an array stands, and what its numbers mean
 * @property {"f8" | "f4" | "u2" | "u4"} type
 * @property {number} offset bytes behind the header
 * @property {number} count
 * @property {number[]} [low] u2: value of 0, for every place modulo their number
 * @property {number[]} [high] u2: value of 65535
 */

import { press } from "./indentation.js";
import { Carried } from "./moving.js";
import { patientAround } from "./patient.js";

const TYPES = { f8: Float64Array, f4: Float32Array, u2: Uint16Array, u4: Uint32Array };
const COLOURS = ["#4aa8ff", "#ff9d2e", "#b58cff", "#5fd38d"]; // of instruments, the first run's first
const LONGEST = 6000; // frames that are kept of a run that goes on; then the older half goes

/** The run that a block of bytes holds. @param {ArrayBuffer} bytes @returns {Recorded} */
export function unpackRecording(bytes) {
  const length = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
  const start = 4 + length;
  return {
    ...header,
    channels: header.channels.map((/** @type {any} */ packed) =>
      ({ ...packed, values: Float64Array.from(unpack(bytes, start, packed)) })),
    walls: header.walls.map((/** @type {any} */ wall) => ({
      kind: wall.kind,
      isSoft: wall.isSoft,
      vertices: Float32Array.from(unpack(bytes, start, wall.vertices)),
      triangles: Uint32Array.from(unpack(bytes, start, wall.triangles)),
    })),
  };
}

export class Recording {
  /** @param {Recorded} run */
  constructor(run) {
    const { title, outcome, warnings, facts, radius, channels, walls, sheath, described } = run;
    this.title = title;
    this.outcome = outcome;
    this.warnings = warnings;
    this.facts = facts;
    this.radius = radius;
    this.channels = new Map(channels.map((channel) => [channel.name, channel]));
    this.walls = walls;
    this.described = described;
    /** Vertices at rest, of walls that give way or move. @type {Map<Wall, Carried>} */
    this._atRest = new Map();
    const bent = this._bent(0);
    walls.forEach((wall, k) => {
      const cycles = described?.motions?.[k] ?? [];
      wall.isStill = !wall.isSoft && !cycles.length && !bent;
      if (!wall.isStill) this._atRest.set(wall, new Carried(wall.vertices.slice(), cycles, bent));
    });
    /** The target, which goes with its vessel. */
    this._target = this.withVessel(Float32Array.from(described?.target?.points.at(-1) ?? []));
    this._cells = this.withVessel(Float32Array.from(described?.cells?.middles ?? []));
    this._isMoved = false;
    this._box = this.box;
    /** Counts how often vertices were moved. */
    this.moves = 0;
    this.sheath = sheath;
    /** Of a unit. */
    this.millimetres = this.described?.millimetresPerUnit ?? 1;
    /** @type {import("./pieces.js").Instrument[]} */
    this.instruments = (this.described?.instruments ?? []).map((one, k) =>
      ({ ...one, name: one.title, colour: COLOURS[k % COLOURS.length] }));
    /** Channels of the instruments' centrelines, the wire's first. */
    this.centrelines = ["positions"];
    while (this.channels.has(`positions${this.centrelines.length}`)) {
      this.centrelines.push(`positions${this.centrelines.length}`);
    }
    /** How many frames at the beginning were forgotten. */
    this.forgotten = 0;
    this._count = this.channel("time").values.length;
    this._columns = [...this.channels.values()];
    /** Where the step stands among the numbers of a frame. */
    this._stepAt = this._columns.slice(0, [...this.channels.keys()].indexOf("step"))
      .reduce((at, channel) => at + channel.width, this._columns.length);
  }

  /** Those that are described and whose centrelines are there. */
  get drawnInstruments() {
    return this.instruments.slice(0, this.centrelines.length);
  }

  /** Outer radius of an instrument, units; that of the wire where it is not known. @param {number} instrument */
  radiusOf(instrument) {
    const known = instrument > 0 ? this.instruments[instrument] : undefined;
    return known ? Math.max(...known.radii) : this.radius;
  }

  /** Gives its instruments other colours. @param {number} first of them */
  recolour(first) {
    this.instruments.forEach((one, k) => {
      one.colour = COLOURS[(first + k) % COLOURS.length];
    });
  }

  /** Lowest and highest corner of what a picture shows by itself: the vessel, or without one where the wire begins,
   * units. @returns {[[number, number, number], [number, number, number]]} */
  get box() {
    const vessels = this.walls.filter((wall) => wall.kind === "vessel");
    const all = vessels.length ? vessels.map((wall) => wall.vertices) : [this.at("positions", 0)];
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const points of all) {
      for (let i = 0; i < points.length; i++) {
        low[i % 3] = Math.min(low[i % 3], points[i]);
        high[i % 3] = Math.max(high[i % 3], points[i]);
      }
    }
    return /** @type {[[number, number, number], [number, number, number]]} */ ([low, high]);
  }

  /** What of a generic patient lies around the vessel. */
  get body() {
    const { patient } = this.described ?? {};
    return patient ? patientAround(patient, this._box, this.millimetres) : [];
  }

  /** Number of frames. */
  get count() {
    return this._count;
  }

  /** @param {string} name @returns {Channel} */
  channel(name) {
    const found = this.channels.get(name);
    if (!found) throw new Error(`there is no channel ${name}`);
    return found;
  }

  /** Numbers of a channel in one frame. @param {string} name @param {number} frame */
  at(name, frame) {
    const { values, width } = this.channel(name);
    return values.subarray(frame * width, (frame + 1) * width);
  }

  /** Numbers of a channel that has one a frame. @param {string} name */
  overTime(name) {
    return this.channel(name).values.subarray(0, this._count);
  }

  /** Moves the vertices of walls that give way to where they are drawn in a frame. @param {number} frame */
  moveWalls(frame) {
    const wasMoved = this._isMoved;
    this._isMoved = false;
    for (const [wall, carried] of this._atRest) {
      if (wasMoved || carried.isMoving) carried.move(wall.vertices, ...this._moment(frame));
      if (carried.isMoving) this._isMoved = true;
      if (!wall.isSoft) continue;
      this.centrelines.forEach((name, k) => {
        const displacements = `wallDisplacements${k || ""}`;
        if (!this.channels.has(displacements)) return;
        if (press(carried.rest, wall.vertices, this.at(name, frame), this.at(displacements, frame), this.radiusOf(k))) {
          this._isMoved = true;
        }
      });
    }
    if (wasMoved || this._isMoved) this.moves++;
  }

  /** The time of a frame, s, and the phase of the vessel's first cycle, where that is known. @param {number} frame
   * and the centreline of a vessel that gives way as a beam.
   * @returns {[number, number?, Float64Array?]} */
  _moment(frame) {
    return [this.at("time", frame)[0], this.channels.has("vesselPhase") ? this.at("vesselPhase", frame)[0] : undefined, this._bent(frame)];
  }

  /** @param {number} frame */
  _bent(frame) {
    return this.channels.has("vesselCentreline") ? this.at("vesselCentreline", frame) : undefined;
  }

  /** Places that go with the vessel. @param {Float32Array} rest */
  withVessel(rest) {
    return new Carried(rest, this.described?.motions?.[0] ?? [], this._bent(0));
  }

  /** Where the target is in a frame, units; without one no place. @param {number} frame */
  targetAt(frame) {
    const place = this._target.rest.slice();
    this._target.move(place, ...this._moment(frame));
    return place;
  }

  /** Where the middles of the cells for contrast agent are, units; null where the vessel stands still. @param {number} frame */
  cellsAt(frame) {
    if (!this._cells.isMoving) return null;
    const places = this._cells.rest.slice();
    this._cells.move(places, ...this._moment(frame));
    return places;
  }

  /** The last sphere that is in a sheath, or the first of all. @param {number} frame */
  firstShown(frame) {
    const spheres = this.channel("positions").width / 3;
    return this.channels.has("inBody") ? Math.max(spheres - 1 - this.at("inBody", frame)[0], 0) : 0;
  }

  /**
   * Adds a frame, but one that it holds already.
   * @param {Float64Array} numbers the largest of each channel, then all channels one behind the other
   */
  append(numbers) {
    if (this._count > 0 && numbers[this._stepAt] <= this.at("step", this._count - 1)[0]) return;
    if (this._count >= LONGEST) this._forget(LONGEST / 2);
    let from = this._columns.length;
    for (const [k, channel] of this._columns.entries()) {
      channel.largest = numbers[k];
      const end = (this._count + 1) * channel.width;
      if (channel.values.length < end) {
        const longer = new Float64Array(2 * end);
        longer.set(channel.values);
        channel.values = longer;
      }
      channel.values.set(numbers.subarray(from, from + channel.width), end - channel.width);
      from += channel.width;
    }
    this._count++;
  }

  /** The frame nearest to a moment. @param {number} time s */
  nearest(time) {
    const times = this.overTime("time");
    let low = 0;
    let high = times.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (times[middle] <= time) low = middle;
      else high = middle;
    }
    return Math.abs(times[high] - time) < Math.abs(times[low] - time) ? high : low;
  }

  /** @param {number} frames */
  _forget(frames) {
    for (const channel of this._columns) {
      channel.values.copyWithin(0, frames * channel.width, this._count * channel.width);
    }
    this._count -= frames;
    this.forgotten += frames;
  }
}

/** @param {ArrayBuffer} bytes @param {number} start @param {Packed} packed @returns {ArrayLike<number>} */
function unpack(bytes, start, packed) {
  const type = TYPES[packed.type];
  const from = start + packed.offset;
  const numbers = new type(bytes.slice(from, from + packed.count * type.BYTES_PER_ELEMENT));
  if (!packed.low || !packed.high) return numbers;
  const { low, high } = packed;
  const every = low.length;
  const span = high.map((value, k) => value - low[k]);
  return Float64Array.from(numbers, (value, k) => low[k % every] + (value / 65535) * span[k % every]);
}
