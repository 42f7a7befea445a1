// @ts-check
/** What a case came to: its figures, strips over one time beside the pictures, and a sentence of advice. */
import { drawCurves } from "./curves.js";
import { byId, make, named } from "./panel.js";
import { largestForce, limitsOf, newtons } from "./score.js";
import { placeName } from "./target.js";
import { fixed, say } from "./words.js";

/**
 * @typedef {import("./score.js").Score} Score
 * @typedef {import("./recording.js").Recording} Recording
 * @typedef {{time: number[], way: number[], force: number[], wire?: number[][]}} Course s, mm of the way to the target, N at a wall,
 *     and points of the wire, units
 */

const PULLED = 5e-3; // m that the hub goes back where it counts
const SAMPLES = 200; // of a course that is kept
export const SHAPE = 16; // points of a wire in it
const IDLE = 0.3; // of the time with the beam on, in which nothing moves

/**
 * What a case came to, row by row.
 * @param {Recording} recording @param {Score} score
 * @param {{case: string, beam: number, pictures: number, contrast: number, exchanges: string[],
 *     stars?: string}} more s with the beam on, ml, and instruments that were exchanged
 * @returns {[string, string][]}
 */
export function rowsOf(recording, score, more) {
  const millimetres = recording.millimetres;
  const target = recording.described?.target;
  const seconds = (/** @type {number} */ value) => `${fixed(value, 1)} s`;
  const mm = (/** @type {number} */ value) => `${fixed(millimetres * value, 0)} mm`;
  const forces = recording.channels.get("hubForce")?.unit === "N";
  return /** @type {[string, string][]} */ ([
    ["case", more.case],
    ...(target ? [["target", `${say(placeName(target.name))}, ${Number.isFinite(score.reachedAt)
      ? say("reached at {0} s", fixed(score.reachedAt, 1)) : say("{0} away", mm(score.left))}`],
    ["score", say("{0} of 100", score.points)]] : []),
    ...(more.stars ? [["stars", more.stars]] : []),
    ["time", seconds(score.time)],
    ["radiation", say("{0} with the beam on, {1} pictures", seconds(more.beam), Math.round(more.pictures))],
    ["contrast", `${fixed(more.contrast, 1)} ml`],
    ...(forces ? [["largest force at the hub", newtons(score.hubForce)], ["largest wall force", newtons(score.wallForce)],
      ...(score.strandForce > 0 ? [["largest force of the wire on itself", newtons(score.strandForce)]] : []),
      ["wall force in the yellow band", seconds(score.caution)], ["wall force in the red band", seconds(score.stop)]] : []),
    ["way of the tip", target ? say("{0} for {1} from the inlet", mm(score.path), mm(target.distances.at(-1) ?? 0)) : mm(score.path)],
    ["new attempts", String(score.retries)],
    ...more.exchanges.map((text) => ["exchange", text]),
    ["events", String(score.mishaps.length)],
    ...score.mishaps.map(({ time, text }) => [say("at {0} s", fixed(time, 1)), text]),
  ].map(([name, value]) => [say(name), value]));
}

/** The course of a run so far. @param {Recording} recording @param {number} first units to the target as it began
 * @returns {Course} */
export function courseOf(recording, first) {
  const frames = Array.from({ length: recording.count }, (_, frame) => frame);
  const hasTarget = recording.channels.has("lumen") && Number.isFinite(first);
  return { time: frames.map((frame) => recording.at("time", frame)[0]), force: frames.map((frame) => largestForce(recording, frame)),
    wire: frames.map((frame) => shapeAt(recording, frame)),
    way: hasTarget ? frames.map((frame) => Math.round(10 * recording.millimetres * (first - recording.at("lumen", frame)[0])) / 10) : [] };
}

/** Points of the wire, from where it comes out of a sheath to its tip. @param {Recording} recording @param {number} frame */
function shapeAt(recording, frame) {
  const [x, first] = [recording.at("positions", frame), recording.firstShown(frame)];
  return Array.from({ length: SHAPE }, (_, k) => Math.round(first + ((x.length / 3 - 1 - first) * k) / (SHAPE - 1)))
    .flatMap((i) => [...x.subarray(3 * i, 3 * i + 3)].map((value) => Math.round(10 * value) / 10));
}

/** A course with fewer samples, each with the largest force of those that it stands for. @param {Course} course
 * @returns {Course} */
export function thinned({ time, way, force, wire = [] }) {
  const every = Math.ceil(time.length / SAMPLES);
  const at = time.flatMap((_, k) => (k % every ? [] : [k]));
  const short = (/** @type {number} */ value) => Number(value.toPrecision(4));
  return { time: at.map((k) => short(time[k])), way: at.map((k) => short(way[k])), wire: at.map((k) => wire[k]),
    force: at.map((k) => short(Math.max(...force.slice(k, k + every)))) };
}

/** When the hub was pulled back: from where it was farthest to where it is there again, s.
 * @param {ArrayLike<number>} time @param {ArrayLike<number>} insertion m @returns {[number, number][]} */
export function pullsOf(time, insertion) {
  /** @type {[number, number][]} */
  const pulls = [];
  for (let k = 1, top = 0, least = Infinity; k < time.length; k++) {
    least = Math.min(least, insertion[k]);
    const isBack = insertion[k] >= insertion[top];
    if ((isBack || k === time.length - 1) && insertion[top] - least >= PULLED) pulls.push([time[top], time[k]]);
    if (isBack) [top, least] = [k, Infinity];
  }
  return pulls;
}

/**
 * The sentence that helps most: what cost most points first.
 * @param {Course} course @param {{pulls: [number, number][], beam: [number, number][], limits: number[] | null,
 *     ghost: Course | null}} more limits of a wall's force, N
 */
export function adviceOn({ time, way, force }, { pulls, beam, limits, ghost }) {
  const [caution, stop] = limits ?? [Infinity, Infinity];
  const peak = force.reduce((best, value, k) => (value > force[best] ? k : best), 0);
  const at = fixed(time[peak], 1);
  if (force[peak] >= stop) return say("At {0} s the wall took {1}: pull back a little and turn the tip before you push on.", at, newtons(force[peak]));
  const end = time.at(-1) ?? 0;
  const whole = end - time[0];
  const lost = pulls.reduce((sum, [from, to]) => sum + to - from, 0);
  if (pulls.length && lost > 0.2 * whole) {
    return say("You pulled back for {0} s: at a branch turn the tip first, then push gently.", fixed(lost, 1));
  }
  if (force[peak] >= caution) return say("At {0} s the wall was pressed with {1}: go slowly there, with fine steering.", at, newtons(force[peak]));
  const isOn = (/** @type {number} */ moment) => beam.some(([from, to]) => moment > from && moment <= to);
  let [on, idle] = [0, 0];
  for (let k = 1; k < time.length; k++) {
    if (!isOn(time[k])) continue;
    on += time[k] - time[k - 1];
    if (way.length && Math.abs(way[k] - way[k - 1]) < 0.2 * (time[k] - time[k - 1])) idle += time[k] - time[k - 1];
  }
  if (way.length && on > 0 && idle > IDLE * on) {
    return say("For {0} s the beam was on and the tip stood still: release the pedal (X) while you think.", fixed(idle, 1));
  }
  if (ghost && way.length && (ghost.time.at(-1) ?? end) < 0.9 * end) {
    const gap = time.map((moment, k) => ghost.way[Math.max(0, ghost.time.filter((one) => one <= moment).length - 1)] - way[k]);
    const worst = gap.reduce((best, value, k) => (value > gap[best] ? k : best), 0);
    return say("At {0} s the ghost was {1} mm ahead of you: look at what it did just before.", fixed(time[worst], 1), fixed(gap[worst], 0));
  }
  return say("Calm hands: no wall was pressed hard and nothing was lost by pulling back.");
}

/** The page's right half, once a run is judged; the pictures beside it show the moment that is pointed at. */
export class Debrief {
  /** @param {(frame: number) => void} go shows a frame in the pictures */
  constructor(go) {
    this._go = go;
    this._box = byId("debrief");
    /** What the strips show, by their names. @type {Record<string, number[]>} */
    this._course = {};
    /** @type {Record<string, number[]> | null} */
    this._ghost = null;
    /** @type {[number, number][]} */
    this._pulls = [];
    /** @type {{name: string, label: string, canvas: any}[]} */
    this._strips = [];
    this._frame = 0;
    /** Ends it, where it is shown. @type {(answer: string) => void} */
    this.close = () => {};
    new ResizeObserver(() => this._draw()).observe(this._box);
  }

  /**
   * @param {{title: string, stars: string, rows: [string, string][], answers: string[], recording: Recording, score: Score,
   *     beam: [number, number][], ghost: {course: Course, name: string} | null}} what answers: the last one is at hand
   * @returns {Promise<string>} the answer
   */
  show({ title, stars, rows, answers, recording, score, beam, ghost }) {
    const course = courseOf(recording, score.first);
    const insertion = recording.channels.has("hubInsertion") ? recording.overTime("hubInsertion") : [];
    const pulls = pullsOf(course.time, insertion);
    const limits = recording.channels.get("hubForce")?.unit === "N" ? limitsOf(recording, 0)?.wall ?? null : null;
    const unit = limits && score.wallForce < 0.1 ? "mN" : "N";
    const [most] = [...course.force.keys()].sort((a, b) => course.force[b] - course.force[a]);
    const figures = [["time", `${fixed(score.time, 1)} s`, ghost ? say("ghost {0} s", fixed(ghost.course.time.at(-1) ?? 0, 1)) : ""],
      ["largest wall force", limits ? newtons(score.wallForce) : "–", most === undefined ? "" : say("at {0} s", fixed(course.time[most], 1))],
      ["pulled back", String(pulls.length), say("for {0} s", fixed(pulls.reduce((sum, [from, to]) => sum + to - from, 0), 1))],
      ["beam", `${fixed(beam.reduce((sum, [from, to]) => sum + to - from, 0), 1)} s`, ""]];
    this._strips = [...(course.way.length ? [["way", "way to the ring, mm"]] : []), ["force", `largest wall force, ${unit}`], ["beam", "beam on"]].map(([name, label]) => {
      const canvas = named("canvas", label, { className: "strip" });
      canvas.setAttribute("role", "img");
      canvas.dataset.name = name;
      canvas.onpointerdown = canvas.onpointermove = (/** @type {PointerEvent} */ event) => {
        if (event.type === "pointerdown" || event.buttons) this._point(recording.nearest(canvas.toX(event.offsetX)));
      };
      return { name, label, canvas };
    });
    const inUnits = (/** @type {Course} */ { time, way, force }) => ({ time, way, force: force.map((value) => (unit === "mN" ? 1000 : 1) * value) });
    this._course = { ...inUnits(course), beam: course.time.map((moment) => Number(beam.some(([from, to]) => moment > from && moment <= to))) };
    [this._ghost, this._pulls] = [ghost && inUnits(ghost.course), pulls];
    this._slider = named("input", "moment of the run", { type: "range", min: 0, max: recording.count - 1, value: recording.count - 1,
      oninput: () => this._point(Number(this._slider.value)) });
    this._when = make("span", { className: "note" });
    const legend = (/** @type {string} */ text, /** @type {string} */ colour) => {
      const made = make("span", { className: "note legend" }, text);
      made.style.setProperty("--of", `var(${colour})`);
      return made;
    };
    return new Promise((done) => {
      const answer = this.close = (/** @type {string} */ text) => {
        delete document.body.dataset.debrief;
        this._box.hidden = true;
        this.close = () => {};
        done(text);
      };
      const saving = make("button", { onclick: () =>
        save("report.txt", rows.map(([name, value]) => `${name}: ${value}\n`).join(""), "text/plain") }, "save report");
      const buttons = answers.map((text, k) => make("button", { className: k === answers.length - 1 ? "on" : "", onclick: () => answer(text) }, text));
      const [signs, ...missed] = stars.split(", ");
      this._box.replaceChildren(make("div", { className: "tools" }, make("span", { className: "stars" }, signs), make("h2", { tabIndex: -1 }, title), saving,
        ...buttons), ...(missed.length ? [make("span", { className: "note" }, missed.join(", "))] : []),
        make("div", { className: "figures" }, ...figures.map(([name, value, more]) => make("div", {}, make("span", { className: "note" }, name),
          make("b", {}, value), make("span", { className: "note" }, more)))),
        make("p", { className: "advice" }, adviceOn(course, { pulls, beam, limits, ghost: ghost?.course ?? null })),
        make("div", { className: "tools" }, legend("you", "--ink"), ...(ghost ? [legend(ghost.name, "--ghost")] : []),
          ...(pulls.length ? [legend("pulled back", "--caution")] : []), this._when),
        ...this._strips.map(({ canvas }) => canvas), this._slider,
        make("details", {}, make("summary", {}, "all figures"), make("dl", { id: "report" },
          ...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]))));
      this._box.hidden = false;
      document.body.dataset.debrief = "";
      this._point(recording.count - 1);
      this._box.querySelector("h2").focus(); // not a button: the space bar that was to pause would press it
    });
  }

  /** @param {number} frame that the pictures and the strips show */
  _point(frame) {
    this._frame = frame;
    this._slider.value = String(frame);
    this._when.textContent = say("at {0} s: point at a strip to go there", fixed(this._course.time[frame], 1));
    this._go(frame);
    this._draw();
  }

  _draw() {
    if (this._box.hidden) return;
    const { time } = this._course;
    for (const { name, label, canvas } of this._strips) {
      const ghost = this._ghost?.[name]?.length ? [{ x: this._ghost.time, y: this._ghost[name], colour: "--ghost", dash: [6, 4] }] : [];
      const whole = { x: [time[0], Math.max(time.at(-1) ?? 0, this._ghost?.time.at(-1) ?? 0)], y: [NaN, NaN] }; // the same time in all of them
      canvas.toX = drawCurves(canvas, [{ x: time, y: this._course[name], colour: "--ink" }, ...ghost, whole], "t, s", say(label),
        time[this._frame], this._pulls);
    }
  }
}

/** Gives the browser a file to save. @param {string} name @param {BlobPart} content @param {string} type */
export function save(name, content, type) {
  const link = make("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
}
