// @ts-check
import { Dial, Gauge } from "./gauges.js";
import { byId, make, named } from "./panel.js";
import { Score, apart, largestForce, limitsOf, newtons } from "./score.js";
import { hum } from "./sounds.js";
import { fixed, say } from "./words.js";

/** @typedef {import("./recording.js").Recording} Recording */

const MILLIMETRES_A_TURN = 100; // of the dial of insertion
const MOST_EVENTS = 3; // that are shown

/** What an operator looks at beside the pictures: forces, insertion and turn, the target, the instruments. */
export class Desk {
  constructor() {
    /** @type {Recording | null} */
    this._recording = null;
    this._held = 0; // instrument whose hub is read off
    this._heard = 0; // frame whose force one heard
    /** Told where somebody turns the dial: rad that the hub is to have. @type {(turn: number) => void} */
    this.onDial = () => {};
    /** Of the hub that is read off, rad. */
    this.turn = 0;
    /** Whether the score goes on while one looks back. */
    this.isLive = false;
  }

  /** @param {Recording[]} recordings the first one is read off */
  set(recordings) {
    const [recording] = recordings;
    this._recording = recording;
    this.score = new Score(recording);
    this._insertion = new Dial("insertion", (millimetres) => (2 * Math.PI * millimetres) / MILLIMETRES_A_TURN);
    this._turn = new Dial("turn", (turn) => turn);
    if (this.isLive) this._turn.listen(() => this.turn, (turn) => this.onDial(turn));
    this._events = make("div", { className: "card", id: "events", hidden: true });
    this._gauges = make("div", { id: "gauges" });
    this._legend = make("div", { className: "card", id: "legend" }, ...recordings.flatMap((one) =>
      one.instruments.map((instrument) => make("div", {}, swatch(instrument.colour),
        recordings.length > 1 ? `${instrument.name}, ${one.title}` : instrument.name))));
    this._cycle = make("div", { className: "card", id: "cycle", hidden: !recording.channels.has("vesselPhase") },
      make("span", {}), named("progress", "phase of the vessel's cycle", { max: 1 }));
    byId("desk").replaceChildren(this._gauges, this._cycle,
      make("div", { className: "dials" }, this._insertion.element, this._turn.element), this._events, this._legend);
    const hasTarget = Boolean(recording.described?.target);
    byId("scoreReading").hidden = !hasTarget;
    byId("way").hidden = false;
    byId("way").querySelector(".track").hidden = !hasTarget;
    document.body.toggleAttribute("data-target", hasTarget);
    this._makeGauges();
  }

  /** Gauges with the bands of the held instrument. */
  _makeGauges() {
    const recording = this._recording;
    if (!recording) return;
    const limits = limitsOf(recording, this._held);
    const wire = limitsOf(recording, 0);
    const isForce = recording.channels.get("hubForce")?.unit === "N";
    this._hub = new Gauge("force at the hub", isForce && limits ? limits.hub : null);
    this._wall = new Gauge("largest wall force", isForce && wire ? wire.wall : null);
    const basis = isForce && limits && wire ? [make("p", { className: "basis" },
      say("Red: 5 cm of shaft bow out at {0}; twice the {1} at which the wire's tip buckles.", newtons(limits.hub[1]),
        newtons(wire.wall[0])))]
      : [];
    this._gauges?.replaceChildren(this._hub.element, this._wall.element, ...basis);
  }

  /** Reads off at the hub of another instrument. @param {number} instrument which the hand holds; -1: none */
  hold(instrument) {
    const held = Math.max(instrument, 0);
    if (held !== this._held) {
      this._held = held;
      this._makeGauges();
    }
    [...(this._legend?.children ?? [])].forEach((line, k) =>
      line.classList.toggle("held", k === instrument && this._legend.children.length > 1));
  }

  /** Shows a frame. @param {number} frame */
  show(frame) {
    const recording = this._recording;
    if (!recording || !this.score) return;
    const hub = this._held && recording.channels.has(`hub${this._held}Force`) ? `hub${this._held}` : "hub";
    if (!this.isLive || !this.score.has(frame)) this.score.show(frame);
    const at = (/** @type {string} */ name) =>
      (recording.channels.has(name) ? recording.at(name, frame)[0] : NaN);
    const unitOf = (/** @type {string} */ name) => recording.channels.get(name)?.unit ?? "";
    this._hub?.show(at(`${hub}Force`), unitOf(`${hub}Force`), recording.channels.get(`${hub}Force`)?.largest ?? 0);
    const force = largestForce(recording, frame);
    hum(this.isLive && frame > this._heard && unitOf("hubForce") === "N" ? force / (limitsOf(recording, 0)?.wall[1] ?? Infinity) : 0);
    this._heard = frame;
    this._wall?.show(force, unitOf("contactForce"), this.score.wallForce);
    const millimetres = recording.millimetres;
    const x = recording.at("positions", frame);
    const [tip, base] = this.score.begun;
    const inserted = recording.channels.has(`${hub}Insertion`) ? 1000 * at(`${hub}Insertion`)
      : millimetres * apart(x.subarray(0, 3), base);
    this._insertion?.show(inserted, `${fixed(inserted, Math.abs(inserted) < 100 ? 1 : 0)} mm`);
    const turn = at(`${hub}Turn`);
    this.turn = turn;
    this._turn?.show(turn, `${Math.round((turn * 180) / Math.PI)}°`);
    byId("clock").textContent = `${fixed(at("time"), 1)} s`;
    byId("score").textContent = String(this.score.points);
    this._showCycle(frame);
    this._showEvents();
    this._showWay(millimetres, apart(x.subarray(-3), tip));
  }

  /** Where a vessel that moves is in its cycle, and how fast that goes now. @param {number} frame */
  _showCycle(frame) {
    if (this._cycle.hidden) return;
    const [phase, before] = [frame, frame - 1].map((k) => this._recording?.at("vesselPhase", Math.max(0, k))[0] ?? 0);
    const [time, earlier] = [frame, frame - 1].map((k) => this._recording?.at("time", Math.max(0, k))[0] ?? 0);
    const rate = time > earlier ? (phase - before + (phase < before ? 1 : 0)) / (time - earlier)
      : 1 / (this._recording?.described?.motions?.[0]?.[0]?.period ?? NaN);
    const [text, bar] = this._cycle.children;
    text.textContent = say("vessel: {0} a minute, phase {1}", fixed(60 * rate, 0), fixed(phase, 2));
    bar.value = phase;
  }

  /** How far it is to the target; without one how far the tip has come. @param {number} millimetres of a unit
   * @param {number} moved units */
  _showWay(millimetres, moved) {
    const { left, first, reachedAt, best } = /** @type {Score} */ (this.score);
    const hasTarget = Number.isFinite(left);
    byId("done").textContent = hasTarget ? `${fixed(millimetres * (first - left), 0)} mm`
      : say("tip {0} mm from its start", fixed(millimetres * moved, 0));
    byId("left").textContent = !hasTarget ? "" : Number.isFinite(reachedAt) ? say("reached at {0} s", fixed(reachedAt, 1))
      : say("{0} mm to go", fixed(millimetres * left, 0));
    const [bar, knob] = byId("way").querySelector(".track").children;
    bar.style.width = `${100 * best}%`;
    knob.style.left = `${hasTarget ? Math.max(0, Math.min(100, 100 * (1 - left / (first || 1)))) : 0}%`;
  }

  _showEvents() {
    const mishaps = this.score?.mishaps ?? [];
    if (!this._events || this._events.dataset.count === String(mishaps.length)) return;
    this._events.hidden = !mishaps.length;
    this._events.dataset.count = String(mishaps.length);
    this._events.replaceChildren(make("div", { className: "line" }, make("span", {}, "events"),
      make("output", {}, String(mishaps.length))), ...mishaps.slice(-MOST_EVENTS).map(({ time, text }) =>
      make("div", { className: "event" }, `${fixed(time, 1)} s: ${text}`)));
  }
}

/** @param {string} colour */
function swatch(colour) {
  const made = make("span", { className: "swatch" });
  made.style.background = colour;
  return made;
}
