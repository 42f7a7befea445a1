// @ts-check
import { Fluoroscopy } from "./fluoroscopy.js";
import { plainLook } from "./look.js";
import { byId, make } from "./panel.js";
import { PlainFluoroscopy } from "./plain.js";

/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./carm.js").Point} Point */

const PIXELS = 512; // of a square picture; others have as many in all
const VIEWS = /** @type {[string, number, number][]} */ ([["AP", 0, 0], ["LAO 30", 30, 0], ["RAO 30", -30, 0],
  ["lateral", 90, 0], ["cranial 25", 0, 25]]);
/** The same of a patient whose axes are unknown. */
const PLAIN_VIEWS = VIEWS.map(([, lao, cranial]) => /** @type {[string, number, number]} */ (
  [cranial ? `tilted ${cranial}°` : `turned ${lao}°`, lao, cranial]));
const DEGREES_A_POINT = 0.4; // of dragging
const WIDEST = 180; // mm, as of a detector: where the vessel is larger the picture goes with the tip
const CLOSE_UP = 80; // mm
const WORN = { noise: 0.022 }; // how a picture looks on the screen
const MOST_CRANIAL = 60;

/** The X-ray view: the C-arm, its buttons and mouse, and the target's mark. */
export class Xray {
  constructor() {
    const canvas = byId("fluoroscopy");
    this.fluoroscopy = makeFluoroscopy(canvas);
    /** @type {Model[]} */
    this._models = [];
    /** How the patient lies; null where it is unknown. @type {import("./carm.js").Patient | null} */
    this._patient = null;
    this._isClose = false;
    this._frames = 0;
    /** Pictures drawn so far. */
    this.drawn = 0;
    /** Told after every picture. @type {() => void} */
    this.onDrawn = () => {};
    /** Told where the C-arm was turned. @type {() => void} */
    this.onTurned = () => {};
    this._isRequested = false;
    this._zoom = 1;
    /** @type {Point | undefined} */
    this._middle = undefined;
    document.body.dataset.xray = "none";
    this._makeTools();
    new ResizeObserver(() => this._fill()).observe(byId("xray"));
    canvas.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
      if (event.buttons) this.turnArm(-DEGREES_A_POINT * event.movementX, DEGREES_A_POINT * event.movementY);
    });
    canvas.addEventListener("wheel", (/** @type {WheelEvent} */ event) => {
      event.preventDefault();
      this.zoom(event.deltaY < 0 ? 1 / 1.15 : 1.15);
    }, { passive: false });
  }

  /** @param {Model[]} models each with a recording */
  set(models) {
    this._models = models.filter(({ recording }) => recording.described);
    document.body.dataset.xray = this._models.length > 0 ? "shown" : "none";
    if (!this._models.length) return;
    const [{ recording }] = this._models;
    this.fluoroscopy.look = { ...plainLook(), ...WORN };
    this._patient = recording.described?.patient ?? null;
    this.fluoroscopy.set(recording.walls, recording.box, recording.millimetres, this._patient,
      recording.described?.cells ?? null);
    this._makeTools();
    this._zoom = 1;
    this._fill();
    this.onTurned();
    this.ask();
  }

  /** Shows the same scene from its start, from where it is seen now. @param {Model[]} models */
  keep(models) {
    this._models = models.filter(({ recording }) => recording.described);
    this._middle = undefined;
    this.ask();
  }

  /** @param {Float64Array | null} parts of the blood in each cell that is contrast agent */
  fill(parts) {
    this.fluoroscopy.parts = parts;
    this.ask();
  }

  /** Where the picture is taken from; null where there is none. */
  get arm() {
    return this._models.length ? this.fluoroscopy.arm : null;
  }

  /** Gives the picture the shape of its pane. */
  _fill() {
    const { clientWidth: width, clientHeight: height } = byId("xray");
    if (!width || !height) return;
    const shape = Math.sqrt(width / height);
    if (this.fluoroscopy.resize(Math.round(PIXELS * shape), Math.round(PIXELS / shape))) this.ask();
  }

  /** Turns the C-arm. @param {number} lao degrees @param {number} cranial */
  turnArm(lao, cranial) {
    const { look } = this.fluoroscopy;
    this.point(look.lao + lao, look.cranial + cranial);
  }

  /** @param {number} lao degrees @param {number} cranial */
  point(lao, cranial) {
    this._turn(lao, cranial);
    this.onTurned();
  }

  /** Turns the C-arm to where another picture is seen from. @param {number[]} towards whoever looks, of unit length */
  lookFrom(towards) {
    const { left, chest, head } = this.fluoroscopy.patient;
    const [toLeft, toChest, toHead] = [left, chest, head].map((axis) =>
      axis.reduce((sum, value, k) => sum + value * towards[k], 0));
    this._turn(Math.atan2(toLeft, toChest) * (180 / Math.PI), Math.asin(Math.max(-1, Math.min(1, toHead))) * (180 / Math.PI));
  }

  /** @param {number} lao degrees @param {number} cranial */
  _turn(lao, cranial) {
    this.fluoroscopy.look.lao = ((((lao + 180) % 360) + 360) % 360) - 180;
    this.fluoroscopy.look.cranial = Math.max(-MOST_CRANIAL, Math.min(MOST_CRANIAL, cranial));
    this.ask();
  }

  /** @param {number} factor on the side of the picture */
  zoom(factor) {
    this._zoom = Math.max(0.1, Math.min(4, this._zoom * factor));
    this.ask();
  }

  /** Asks for a picture when the screen takes the next one. */
  ask() {
    if (this._isRequested || !this._models.length || document.body.dataset.views === "space") return;
    this._isRequested = true;
    requestAnimationFrame(() => {
      this._isRequested = false;
      this._draw();
    });
  }

  _draw() {
    if (!this._models.length) return;
    const { look } = this.fluoroscopy;
    const [{ recording, watchedTip }] = this._models;
    look.centre = null;
    look.field = null;
    const { columns, rows, scale } = this.fluoroscopy.arm;
    const whole = (Math.min(columns, rows) / scale) * recording.millimetres;
    look.field = this._zoom * Math.min(whole, this._isClose ? CLOSE_UP : WIDEST);
    if (look.field < whole) {
      look.centre = this._kept(/** @type {Point} */ ([...watchedTip]), look.field / recording.millimetres);
    }
    look.seed = this._frames++;
    this.fluoroscopy.draw(this._models.flatMap((model) => model.recording.drawnInstruments.map((instrument, k) =>
      k === 0 ? model.imagedWire(instrument)
        : /** @type {[import("./pieces.js").Instrument, Float64Array]} */ ([instrument, model.centreline(k)]))));
    this._label();
    this.drawn++;
    this.onDrawn();
  }

  /**
   * A middle that moves only when the tip is about to leave the picture.
   * @param {Point} tip @param {number} side units
   */
  _kept(tip, side) {
    const last = this._middle;
    const isIn = last && last.every((value, k) => Math.abs(value - tip[k]) < 0.3 * side);
    if (!isIn) this._middle = tip;
    return this._middle ?? tip;
  }

  _label() {
    const { lao, cranial, field } = this.fluoroscopy.look;
    const angle = (/** @type {number} */ value, /** @type {string[]} */ names) =>
      `${names[value < 0 ? 1 : 0]} ${Math.abs(Math.round(value))}°`;
    const [turned, tilted] = this._patient ? [["LAO", "RAO"], ["CRAN", "CAUD"]]
      : [["turned", "turned −"], ["tilted", "tilted −"]];
    byId("arm").textContent = `${angle(lao, turned)}  ${angle(cranial, tilted)}\n${Math.round(field ?? 0)} mm${
      this._patient ? "" : ", axes unknown"}`;
    for (const button of byId("armTools").querySelectorAll("button[data-lao]")) {
      button.setAttribute("aria-pressed", String(Number(button.dataset.lao) === Math.round(lao)
        && Number(button.dataset.cranial) === Math.round(cranial)));
    }
    const target = this._models[0].recording.described?.target;
    const mark = byId("reticle");
    mark.hidden = !target;
    if (!target) return;
    const { arm } = this.fluoroscopy;
    const [x, y] = arm.project(target.points[target.points.length - 1], 0, [0, 0, 0]);
    const canvas = byId("fluoroscopy");
    mark.hidden = !(x > 0 && x < arm.columns && y > 0 && y < arm.rows);
    mark.style.transform = `translate(${(x / arm.columns) * canvas.clientWidth}px, ${
      (y / arm.rows) * canvas.clientHeight}px)`;
  }

  _makeTools() {
    const close = make("button", { id: "close", onclick: () => {
      this._isClose = !this._isClose;
      close.setAttribute("aria-pressed", String(this._isClose));
      this._middle = undefined;
      this.ask();
    } }, "tip close up");
    close.setAttribute("aria-pressed", String(this._isClose));
    const vessel = make("select", { id: "vessel", onchange: () => {
      this.fluoroscopy.look.vessel = vessel.value;
      this.ask();
    } }, ...[["roadmap", "road map"], ["contrast", "contrast"], ["none", "no contrast"]].map(([value, text]) =>
      make("option", { value }, text)));
    vessel.setAttribute("aria-label", "vessel");
    const near = make("button", { onclick: () => this.zoom(1 / 1.25) }, "+");
    near.setAttribute("aria-label", "nearer");
    const far = make("button", { onclick: () => this.zoom(1.25) }, "−");
    far.setAttribute("aria-label", "farther");
    byId("armTools").replaceChildren(...(this._patient ? VIEWS : PLAIN_VIEWS).map(([name, lao, cranial]) => {
      const button = make("button", { onclick: () => this.point(lao, cranial) }, name);
      Object.assign(button.dataset, { lao, cranial });
      return button;
    }), vessel, close, near, far);
  }
}

/** @param {HTMLCanvasElement} canvas @returns {Fluoroscopy | PlainFluoroscopy} */
function makeFluoroscopy(canvas) {
  try {
    return new Fluoroscopy(canvas, PIXELS);
  } catch (error) {
    console.info(`X-ray pictures without a shader: ${error}`);
    return new PlainFluoroscopy(canvas, PIXELS);
  }
}
