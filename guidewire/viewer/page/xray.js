// @ts-check
import { Beam, Cine } from "./beam.js";
import { SecondPlane } from "./biplane.js";
import { Fluoroscopy } from "./fluoroscopy.js";
import { PIXELS, plainLook } from "./look.js";
import { byId, make, menu, named } from "./panel.js";
import { PlainFluoroscopy } from "./plain.js";
import { fixed, say } from "./words.js";

/** @typedef {import("./model.js").Model} Model */
/** @typedef {import("./carm.js").Point} Point */

const VIEWS = /** @type {[string, number, number][]} */ ([["AP", 0, 0], ["LAO 30", 30, 0], ["RAO 30", -30, 0],
  ["lateral", 90, 0], ["cranial 25", 0, 25]]);
/** The same of a patient whose axes are unknown. */
const PLAIN_VIEWS = VIEWS.map(([, lao, cranial]) => /** @type {[string, number, number]} */ (
  [cranial ? `from ${cranial}° above` : lao === 0 ? "front" : `${Math.abs(lao)}° ${lao > 0 ? "left" : "right"}`, lao, cranial]));
const DEGREES_A_POINT = 0.4; // of dragging
const WIDEST = 180; // mm, of the picture at first: where the vessel is larger the picture goes with the tip
const FIELDS = [480, 320, 220, 150]; // mm, of a detector's magnifications
const BARS = [1, 2, 5, 10, 20, 50, 100]; // mm, of the scale
const CLOSE_UP = 80; // mm
const WORN = { noise: 0.022 }; // how a picture looks on the screen
const MOST_CRANIAL = 60;
const CLEAR = 1.7; // pixels: half of the width that an instrument has at least in a picture
const [WIRE_DEPTH, CATHETER_DEPTH] = [2.5, 0.4]; // half of what rays through the middle are weakened by, at least

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
    /** Side of the picture that was chosen, mm; 0: as it fits. */
    this._field = 0;
    /** Where the table was moved to, units. @type {Point} */
    this._table = [0, 0, 0];
    this.beam = new Beam(() => this.ask());
    this.cine = new Cine(byId("cine"));
    this.second = new SecondPlane(makeFluoroscopy);
    /** @type {{lao: number, cranial: number, field: number}[]} */
    this._stored = [];
    this._frames = 0;
    /** Pictures drawn so far. */
    this.drawn = 0;
    /** Told after every picture. @type {() => void} */
    this.onDrawn = () => {};
    /** Told where the buttons of views are made anew. @type {() => void} */
    this.onViews = () => {};
    this.together = make("button", { id: "together" }, "turn as one");
    this.together.title = say("C-arm and 3D picture turn together");
    this.together.setAttribute("aria-pressed", "true");
    /** Told where the C-arm was turned. @type {() => void} */
    this.onTurned = () => {};
    this._isRequested = false;
    this._zoom = 1;
    /** @type {Point | undefined} */
    this._middle = undefined;
    document.body.dataset.xray = "none";
    this._makeTools();
    this._makeArm();
    new ResizeObserver(() => this._fill()).observe(byId("xray"));
    canvas.addEventListener("pointermove", (/** @type {PointerEvent} */ event) => {
      if (!event.buttons) return;
      const side = Math.min(canvas.clientWidth, canvas.clientHeight);
      if (event.shiftKey || event.buttons === 4) this.pan(event.movementX / side, event.movementY / side);
      else this.turnArm(-DEGREES_A_POINT * event.movementX, DEGREES_A_POINT * event.movementY);
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
    /** @type {Parameters<Fluoroscopy["set"]>} */
    const seen = [recording.walls, recording.box, recording.millimetres, this._patient, recording.described?.cells ?? null,
      recording.body];
    byId("patient").parentElement.hidden = !recording.body.length;
    this.fluoroscopy.set(...seen);
    this.second.set(...seen);
    this.beam.restart();
    this._table = [0, 0, 0];
    this._makeTools();
    this._makeArm();
    this._zoom = 1;
    this._fill();
    byId("measured").onchange = () => this.ask();
    const route = recording.described?.target?.points.flat();
    if (route) this._turn(widest(this._patient ? recording.walls[0]?.vertices ?? route : route, this.fluoroscopy.patient), 0);
    this.onTurned();
    this.ask();
  }

  /** Shows the same scene from where it is seen now. @param {Model[]} models
   * @param {boolean} goesOn whether the run does, with another instrument; else it is at its start */
  keep(models, goesOn) {
    if (!goesOn) this.beam.restart();
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
    if (this.fluoroscopy.fit(byId("xray"))) this.ask();
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

  /** Moves the table. @param {number} across parts of the picture's side, to the right @param {number} down */
  pan(across, down) {
    const { arm } = this.fluoroscopy;
    const side = Math.min(arm.columns, arm.rows) / arm.scale;
    this._table = /** @type {Point} */ (this._table.map((value, k) =>
      value + side * (down * arm.up[k] - across * arm.right[k])));
    this.ask();
  }

  /** Asks for a picture when the screen takes the next one and the beam gives it. */
  ask() {
    if (this._isRequested || !this._models?.length) return;
    byId("xray").classList.toggle("off", !this.beam.isOn);
    const { wait } = this.beam;
    this._isRequested = true;
    setTimeout(() => requestAnimationFrame(() => {
      this._isRequested = false;
      if (this.beam.isOn) this._draw();
      else {
        const [{ recording, frame }] = this._models;
        this.beam.pass(recording.at("time", frame)[0]);
        this._label();
        this.onDrawn(); // the last picture stays
      }
    }), wait);
  }

  /** Instruments with the points of their centrelines.
   * @returns {[import("./pieces.js").Instrument, Float64Array][]} */
  get _instruments() {
    return this._models.flatMap((model) => model.recording.drawnInstruments.flatMap((instrument, k) => {
      /** @type {[import("./pieces.js").Instrument, Float64Array][]} */
      const shown = [k === 0 ? model.imagedWire(instrument) : [instrument, model.centreline(k)]];
      if (k === 0 && instrument.bands?.length) {
        shown.push([{ ...instrument, attenuations: instrument.radii.map(() => 0) }, model.centreline(0)]); // markers
      }
      return shown;
    }));
  }

  /** The same as one sees them at a glance, wider and darker than they absorb; or as they do where that is asked for. */
  get _clearInstruments() {
    if (byId("measured").checked) return this._instruments;
    const { scale } = this.fluoroscopy.arm;
    return this._instruments.map(([instrument, points]) => {
      const depth = instrument.name === this._models[0].recording.instruments[0].name ? WIRE_DEPTH : CATHETER_DEPTH;
      const radii = instrument.radii.map((radius) => Math.max(radius, CLEAR / scale));
      const attenuations = instrument.attenuations.map((value, k) => (value > 0 ? Math.max(value, depth / radii[k]) : 0));
      return /** @type {[import("./pieces.js").Instrument, Float64Array]} */ (
        [{ ...instrument, radii, attenuations, innerRadii: radii.map(() => 0) }, points]);
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
    look.field = this._zoom * (this._field || Math.min(whole, this._isClose ? CLOSE_UP : WIDEST));
    const [low, high] = this.fluoroscopy.box;
    look.centre = /** @type {Point} */ (low.map((value, k) => 0.5 * (value + high[k])));
    if (look.field < whole) {
      look.centre = this._kept(/** @type {Point} */ ([...watchedTip]), look.field / recording.millimetres);
    }
    look.centre = /** @type {Point} */ (look.centre.map((value, k) => value + this._table[k]));
    look.seed = this._frames++;
    const instruments = this._clearInstruments;
    this.fluoroscopy.moves = recording.moves;
    if (this.fluoroscopy.parts) this.fluoroscopy.middles = recording.cellsAt(this._models[0].frame);
    this.fluoroscopy.showsPatient = byId("patient").checked && !byId("measured").checked;
    this.fluoroscopy.draw(instruments, !byId("measured").checked);
    this.cine.take(this.fluoroscopy.canvas);
    this.beam.take(recording.at("time", this._models[0].frame)[0]);
    this.second.draw(this.fluoroscopy, instruments);
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
    const [{ recording, watchedTip }] = this._models;
    byId("arm").textContent = [this.fluoroscopy.angles.join("  "), [`${Math.round(field ?? 0)} mm`, say("beam {0} s", fixed(this.beam.seconds, 1))].join(" · "),
      ...(!this._patient ? [say("front assumed")] : this.fluoroscopy.showsPatient && recording.body.length ? [say("generic patient")] : []),
      ...(this.fluoroscopy.look.vessel === "map" && !this.fluoroscopy.hasMap ? [say("no injection seen from here")] : []),
      ...(this.beam.isOn ? [] : [say("beam off: last image")])].join("\n");
    /** @type {any} */ (document.querySelector("#carm g")).style.transform = `rotate(${lao}deg)`;
    this._measure(field ?? 1);
    const [left, up] = [byId("lao"), byId("cranial")];
    if (left) [left.value, up.value] = [String(lao), String(cranial)];
    for (const button of byId("carmTools").querySelectorAll("button[data-lao]")) {
      button.setAttribute("aria-pressed", String(Number(button.dataset.lao) === Math.round(lao)
        && Number(button.dataset.cranial) === Math.round(cranial)));
    }
    const target = recording.described?.target;
    this._mark("tipMark", watchedTip);
    this._mark("reticle", target ? recording.targetAt(this._models[0].frame) : undefined);
    byId("reticle").lastElementChild.textContent = target ? byId("left").textContent : "";
  }

  /** Marks a place of the picture. @param {string} id of the mark @param {ArrayLike<number>} [place] units */
  _mark(id, place) {
    const { arm } = this.fluoroscopy;
    const [x, y] = place ? arm.project(place, 0, [0, 0, 0]) : [-1, -1];
    const { clientWidth, clientHeight } = byId("fluoroscopy");
    byId(id).hidden = !(x > 0 && x < arm.columns && y > 0 && y < arm.rows);
    byId(id).style.transform = `translate(${(x / arm.columns) * clientWidth}px, ${(y / arm.rows) * clientHeight}px)`;
  }

  /** The bar of the scale. @param {number} field mm of the shorter side */
  _measure(field) {
    const { clientWidth, clientHeight } = byId("xray");
    const points = Math.min(clientWidth, clientHeight) / field; // a mm
    const length = BARS.filter((one) => one * points < 0.3 * clientWidth).at(-1) ?? BARS[0];
    const [line, label] = byId("scaleBar").children;
    line.style.width = `${length * points}px`;
    label.textContent = `${length} mm`;
  }

  /** Sliders and stored views. */
  _makeArm() {
    const slider = (/** @type {string} */ id, /** @type {string} */ label, /** @type {number} */ most) => make("label", {},
      label, " ", make("input", { type: "range", id, min: -most, max: most, step: 1, value: 0,
        oninput: () => this.point(Number(byId("lao").value), Number(byId("cranial").value)) }));
    const stored = make("span", { className: "tools" });
    const show = () => stored.replaceChildren(...this._stored.map((view, k) => make("button", { onclick: () => {
      byId("field").value = String(this._field = view.field);
      this.point(view.lao, view.cranial);
    } }, say("view {0}", k + 1))));
    const store = make("button", { id: "store", onclick: () => {
      const { lao, cranial } = this.fluoroscopy.look;
      this._stored = [...this._stored, { lao, cranial, field: this._field }].slice(-4);
      show();
    } }, "store view");
    const home = make("button", { onclick: () => {
      this._table = [0, 0, 0];
      this.ask();
    } }, "table back");
    const views = (this._patient ? VIEWS : PLAIN_VIEWS).map(([name, lao, cranial]) => {
      const button = make("button", { onclick: () => this.point(lao, cranial) }, name);
      Object.assign(button.dataset, { lao, cranial });
      return button;
    });
    byId("carmTools").replaceChildren(make("p", { className: "tools" }, ...views), slider("lao", "left and right", 180), slider("cranial", "cranial and caudal", MOST_CRANIAL),
      make("p", { className: "tools" }, store, home, stored), make("p", { className: "basis" },
        "Shift and dragging, or Shift and arrows, move the table."));
  }

  /** Buttons of subtraction and of the mask. */
  _subtraction() {
    const { fluoroscopy } = this;
    if (!(fluoroscopy instanceof Fluoroscopy)) return [];
    const shifts = [0, 1].map((axis) => {
      const field = named("input", `pixel shift of the mask, ${axis ? "down" : "right"}`, { type: "number", min: -20, max: 20, step: 1, value: 0,
        oninput: () => {
          fluoroscopy.look.shift[axis] = Number(field.value) || 0;
          this.ask();
        } });
      field.hidden = true;
      return field;
    });
    const subtract = make("button", { id: "subtract", onclick: () => {
      fluoroscopy.look.isSubtracted = !fluoroscopy.look.isSubtracted;
      fluoroscopy.look.shift = [0, 0];
      if (fluoroscopy.look.isSubtracted) fluoroscopy.takeMask(this._clearInstruments);
      subtract.setAttribute("aria-pressed", String(fluoroscopy.look.isSubtracted));
      for (const field of shifts) [field.hidden, field.value] = [!fluoroscopy.look.isSubtracted, "0"];
      this.ask();
    }, title: "takes a mask now, and shows what has changed since" }, "subtract");
    subtract.setAttribute("aria-pressed", "false");
    return [subtract, ...shifts];
  }

  _makeTools() {
    const close = make("button", { id: "close", onclick: () => {
      this._isClose = !this._isClose;
      close.setAttribute("aria-pressed", String(this._isClose));
      this._middle = undefined;
      this.ask();
    } }, "tip close up");
    close.setAttribute("aria-pressed", String(this._isClose));
    const vessel = named("select", "vessel", { id: "vessel", onchange: () => {
      this.fluoroscopy.look.vessel = vessel.value;
      this.ask();
    } }, ...[["roadmap", "drawn road map"], ["contrast", "filled vessel"], ["none", "no contrast"],
      ...(this._models[0]?.recording.described?.cells ? [["map", "road map of the injection"]] : [])].map(([value, text]) =>
      make("option", { value }, text)));
    const fields = named("select", "field of view", { id: "field", onchange: () => {
      this._field = Number(fields.value);
      this._zoom = 1;
      this.ask();
    } }, make("option", { value: 0 }, "fit"), ...FIELDS.map((field) => make("option", { value: field }, `${field} mm`)));
    fields.value = String(this._field);
    const views = [["both", "X-ray and 3D"], ["xray", "X-ray alone"], ["space", "3D and X-ray"], ["biplane", "biplane"]].map(([name, text]) => {
      const button = make("button", {}, text);
      button.dataset.views = name;
      return button;
    });
    byId("armTools").replaceChildren(vessel, this.beam.button, named("button", "nearer", { onclick: () => this.zoom(1 / 1.25) }, "+"),
      named("button", "farther", { onclick: () => this.zoom(1.25) }, "−"), menu("xrayMore", "more of the X-ray", this.beam.rates, fields,
        ...this._subtraction(), this.cine.element, close, named("span", "views", { className: "tools" }, ...views), this.together));
    this.onViews();
  }
}

/** The turn of the C-arm from which places are seen at their widest, degrees. @param {ArrayLike<number>} places x, y, z each
 * @param {import("./carm.js").Patient} patient */
function widest(places, { left, chest }) {
  const spread = (/** @type {number} */ lao) => {
    const [cos, sin] = [Math.cos(lao * (Math.PI / 180)), Math.sin(lao * (Math.PI / 180))];
    const [x, y, z] = left.map((value, k) => cos * value - sin * chest[k]);
    let [low, high] = [Infinity, -Infinity];
    for (let i = 0; i < places.length; i += 3) {
      const across = x * places[i] + y * places[i + 1] + z * places[i + 2];
      [low, high] = [Math.min(low, across), Math.max(high, across)];
    }
    return high - low;
  };
  return [0, 30, -30, 60, -60, 90].reduce((best, lao) => (spread(lao) > 1.1 * spread(best) ? lao : best), 0);
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
