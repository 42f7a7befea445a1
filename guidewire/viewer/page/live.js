// @ts-check
import { brief } from "./colours.js";
import { Model } from "./model.js";
import { byId, make } from "./panel.js";
import { Recording } from "./recording.js";
import { Steering } from "./steering.js";

/**
 * What is said of the run, as guidewire/viewer/live.py or run.js sends it.
 * @typedef {object} Status
 * @property {boolean} hand whether this page has the run in its hand
 * @property {boolean} isFree whether no page has
 * @property {boolean} isSteered whether push and turn do something
 * @property {boolean} isPaused
 * @property {number} opened how often a run was opened: another number, another recording
 * @property {number} pace of in-game time against the clock
 * @property {number[]} paces
 * @property {string} scene
 * @property {string[]} scenes
 * @property {string} outcome empty while the run goes on
 * @property {string} problem empty where there is none
 * @property {string} steered why what was steered cannot be saved; empty where it can
 * @property {Record<string, number | string>} values the parameters that may be changed
 * @property {Record<string, string[]>} choices of those that are words
 * @property {string[]} instruments the wire, and the catheters over it
 * @property {number} held which of them the hand holds
 * @property {string[][]} named for each the names that can stand for it; empty where the method takes none
 * @property {string[]} chosen the name that each has; empty where it has none
 */

/** A run that goes on in the runner. Here are only keys and pictures. */
export class Live {
  /**
   * @param {import("./stage.js").Stage} stage @param {import("./panel.js").Panel} panel
   * @param {import("./desk.js").Desk} desk @param {import("./xray.js").Xray} xray
   * @param {import("./connection.js").Connection} connection
   */
  constructor(stage, panel, desk, xray, connection) {
    this._stage = stage;
    this._panel = panel;
    this._desk = desk;
    this._xray = xray;
    /** @type {Model | null} */
    this.model = null;
    /** @type {Status | null} */
    this.status = null;
    /** Frames that have come. */
    this.received = 0;
    /** Number of the scene whose recording is shown, as the server counts. */
    this._opened = 0;
    /** Frames that came before the recording of their scene, each after its two numbers. @type {Float64Array[]} */
    this._early = [];
    /** Times from a key to the picture that shows what it did, ms. @type {number[]} */
    this.delays = [];
    this.steering = new Steering((push, turn) => this._tell(push, turn), (button) =>
      this.send(button === "pause" ? { do: "pause", value: !this.status?.isPaused } : { do: "reset" }));
    /** The frame that is looked back at; null: the newest. @type {number | null} */
    this._back = null;
    /** Whether a value was sent that the server has not answered. */
    this._isSent = false;
    this._mark = 0;
    this._marks = new Map();
    this._newest = 0;
    stage.onDrawn = xray.onDrawn = () => this._shown();
    this._connection = connection;
    connection.onmessage = (message) => (message instanceof ArrayBuffer ? this._take(message) : this._hear(message));
    connection.onclose = (reason) => panel.say([reason]);
    document.addEventListener("visibilitychange", () => document.hidden && this.send({ do: "pause", value: true }));
  }

  /** @param {Record<string, any>} message */
  send(message) {
    this._connection.send(message);
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether the key means something here */
  key(event) {
    if (this.steering.key(event)) byId("keys").hidden = true;
    else if (event.key === " ") this.send({ do: "pause", value: !this.status?.isPaused });
    else if (event.key === "n") this.send({ do: "step" });
    else if (event.key === "i") this._holdNext();
    else if (event.key === "r") this.send({ do: "reset" });
    else return false;
    return true;
  }

  /** Puts the next instrument into the hand. */
  _holdNext() {
    const { held, instruments } = this.status ?? { held: 0, instruments: [""] };
    this.send({ do: "hold", instrument: (held + 1) % instruments.length });
  }

  /** @param {number} push @param {number} turn from -1 to 1 */
  _tell(push, turn) {
    this._marks.set(++this._mark, performance.now());
    this.send({ do: "hand", push, turn, mark: this._mark });
  }

  /** @param {Status} status */
  async _hear(status) {
    const isNew = this.status?.opened !== status.opened;
    const wasHand = this.status?.hand;
    this.status = status;
    if (isNew) {
      const recorded = await this._connection.recording(status.opened);
      if (recorded) this._open(new Recording(recorded), status.opened);
    }
    if (isNew || wasHand !== status.hand || status.hand) this._makeControls(status);
    this._desk.hold(status.isSteered ? status.held : -1);
    this._panel.say([status.problem, status.outcome, ...(this.model?.recording.warnings ?? [])].filter(Boolean));
  }

  /** @param {Recording} recording @param {number} opened number of its scene */
  _open(recording, opened) {
    this._opened = opened;
    for (const frame of this._early.filter(([, of]) => of === opened)) recording.append(frame.subarray(2));
    this._early = this._early.filter(([, of]) => of > opened);
    this.model?.dispose();
    const before = this.model?.recording.title;
    this.model = new Model(recording);
    this._stage.set([[this.model]]);
    this._panel.set([this.model], false);
    this._desk.set([recording]);
    this._back = null;
    this.show();
    if (before !== recording.title) this._xray.set([this.model]);
    else this._xray.keep([this.model]);
    if (before !== recording.title) this._stage.frameAll(true);
    this._label();
  }

  /** @param {ArrayBuffer} data */
  _take(data) {
    const numbers = new Float64Array(data);
    this.received++;
    this._newest = numbers[0];
    this.send({ do: "shown" });
    if (numbers[1] > this._opened) this._early.push(numbers);
    if (!this.model || numbers[1] !== this._opened) return;
    const { recording } = this.model;
    const before = recording.forgotten;
    recording.append(numbers.subarray(2));
    if (recording.forgotten > before) this._desk.score?.forget(recording.forgotten - before);
    this._back = null;
    this.model.frame = recording.count - 1;
    this.show();
    this._label();
  }

  /** Shows the newest frame with what is chosen beside it. */
  show() {
    if (!this.model) return;
    const { recording } = this.model;
    const frame = this._back ?? recording.count - 1;
    this._panel.show([frame], recording.at("time", frame)[0]);
    this._desk.show(frame);
    this._xray.ask();
    const slider = byId("back");
    if (slider) {
      slider.max = String(recording.count - 1);
      slider.value = String(frame);
    }
  }

  /** Looks back, at a frame that is kept. @param {number} frame */
  lookBack(frame) {
    if (!this.model) return;
    this._back = frame < this.model.recording.count - 1 ? frame : null;
    this.show();
    this._label();
  }

  _shown() {
    for (const [mark, time] of this._marks) {
      if (mark > this._newest) continue;
      this._marks.delete(mark);
      this.delays.push(performance.now() - time);
    }
  }

  _label() {
    if (!this.model) return;
    const { recording, frame } = this.model;
    const [time, step, stepTime] = ["time", "step", "stepTime"].map((name) => recording.at(name, frame)[0]);
    const rate = recording.at("realTime", frame)[0];
    this._stage.label(0, `t = ${brief(time)} s   step ${step}${
      Number.isFinite(rate) ? `\n${brief(stepTime, 3)} ms a step: ${brief(rate, 3)} times real time` : ""}`);
    byId("title").textContent = nameOf(recording.title);
    byId("mood").textContent = this._mood();
  }

  /** Whether there is no runner any more. @param {Status} status */
  _isGone(status) {
    return status.problem !== "" && !Object.keys(status.values).length;
  }

  /** Saves what was steered as files of the browser, one for each instrument. */
  async _save() {
    if (!this.status) return;
    const { instruments, chosen, named } = this.status;
    const files = instruments.map((_, k) => (k === 0 ? "steered.csv" : `steered-${k}.csv`));
    for (const [k, file] of files.entries()) {
      const { ok, text } = await this._connection.steered(k);
      if (!ok) {
        this._panel.say([`nothing was saved: ${text}`]);
        return;
      }
      const link = make("a", { href: URL.createObjectURL(new Blob([text], { type: "text/csv" })), download: file });
      link.click();
      URL.revokeObjectURL(link.href);
    }
    const keys = files.map((file, k) => {
      const own = k === 0 ? "" : `catheters[${k - 1}].`;
      return `--set ${own}insertionSpeed=0 --set ${own}driveFile=${file} `
        + (named.length && chosen[k] ? `--set ${own}instrument=${chosen[k]} ` : "");
    }).join("");
    const steps = this.model ? this.model.recording.at("step", this.model.recording.count - 1)[0] : 0;
    this._panel.say([`steered.csv: repeat it with 'run ${this.status.scene} ${keys}--set maxSimulationSteps=${steps} `
      + "--set deltaThreshold=0'"]);
  }

  _mood() {
    if (!this.status) return "";
    if (this._back !== null) return "looking back";
    if (this.status.outcome) return "ended";
    if (this._isGone(this.status)) return "the simulation has ended unexpectedly: start anew";
    if (!this.status.hand) return this.status.isFree ? "nobody is steering" : "watching: another page is steering";
    if (this.status.isPaused) return "paused";
    return this.status.isSteered ? "" : "moved by its file's drive";
  }

  /** @param {Status} status */
  _makeControls(status) {
    const button = (/** @type {string} */ text, /** @type {object} */ message) =>
      make("button", { onclick: () => this.send(message) }, text);
    const held = (/** @type {string} */ text, /** @type {string} */ key, /** @type {string} */ cap) =>
      make("button", { className: "drive", onpointerdown: () => this.steering.hold(key),
        onpointerup: () => this.steering.release(), onpointerleave: () => this.steering.release() },
      text, " ", make("kbd", {}, cap));
    const pad = make("div", { id: "pad" }, make("span", {}, "push"), make("span", {}, "pull"));
    pad.setAttribute("role", "application");
    pad.setAttribute("aria-label", "touch: up pushes, down pulls, sideways turns");
    this.steering.listen(pad);
    const save = make("button", { id: "save", onclick: () => this._save(), title: status.steered
      || "the table repeats the motion: key driveFile" }, "save steering");
    save.disabled = status.steered !== "";
    const newest = (this.model?.recording.count ?? 1) - 1;
    const back = make("input", { type: "range", id: "back", min: 0, step: 1, max: newest, value: this._back ?? newest,
      oninput: () => this.lookBack(Number(back.value)) });
    back.setAttribute("aria-label", "look back");
    const scenes = make("select", { id: "scenes", onchange: () => this.send({ do: "open", scene: scenes.value }) },
      ...status.scenes.map((scene) =>
        make("option", { value: scene, selected: scene === status.scene }, nameOf(scene))));
    const paces = make("select", { id: "pace", onchange: () => this.send({ do: "pace", value: Number(paces.value) }) },
      ...status.paces.map((pace) =>
        make("option", { value: pace, selected: pace === status.pace }, `${pace} x real time`)));
    scenes.setAttribute("aria-label", "scene");
    paces.setAttribute("aria-label", "speed");
    const hold = make("button", { id: "hold", onclick: () => this._holdNext(), title: "the steered instrument" },
      status.instruments[status.held] ?? "", " ", make("kbd", {}, "I"));
    const isOurs = status.hand;
    const isOver = status.outcome !== "" || this._isGone(status);
    byId("bar").replaceChildren(...(isOurs ? [
      ...(status.isSteered ? [pad, held("push", "w", "W"), held("pull", "s", "S"), held("turn left", "a", "A"),
        held("turn right", "d", "D"), ...(status.instruments.length > 1 ? [hold] : [])] : []),
      make("span", { className: "buttons" },
        ...(isOver ? [] : [button(status.isPaused ? "go on" : "pause", { do: "pause", value: !status.isPaused }),
          button("step", { do: "step" })]),
        button("start anew", { do: "reset" }), save, ...(status.isPaused && newest > 0 ? [back] : []),
        button(status.isSteered ? "file's drive" : "interactive",
          { do: "open", scene: status.scene, hand: !status.isSteered }), paces, scenes),
    ] : status.isFree ? [button("take control", { do: "take" })]
      : [make("span", {}, "another page is steering; when it is closed you can take over")]));
    const typed = byId("controls").contains(document.activeElement) ? document.activeElement : null;
    if (typed && !this._isSent) return; // a value that is being typed
    this._isSent = false;
    byId("controls").replaceChildren(...(isOurs ? status.named.map((names, k) => {
      const select = make("select", { onchange: () => this.send({ do: "name", instrument: k, name: select.value }) },
        ...[...(status.chosen[k] ? [] : [""]), ...names].map((name) =>
          make("option", { value: name, selected: name === status.chosen[k], disabled: name === "" }, name)));
      return make("label", {}, k === 0 ? "instrument" : `catheter${status.named.length > 2 ? ` ${k}` : ""}`, select);
    }) : []), ...(isOurs ? Object.entries(status.values).map(([key, value]) => {
      const set = () => {
        this._isSent = true; // the answer puts what is in force into the field, also where the value is refused
        this.send({ do: "set", key, value: key in status.choices ? input.value : Number(input.value) });
      };
      const input = key in status.choices
        ? make("select", { onchange: set }, ...status.choices[key].map((word) =>
          make("option", { value: word, selected: word === value }, word)))
        : make("input", { type: "number", step: "any", value, onchange: set });
      return make("label", {}, key, input);
    }) : []));
    this._label();
  }
}

/** A scene as one calls it. @param {string} file */
function nameOf(file) {
  return file.replace(/^.*\//, "").replace(/\.json$/, "").replaceAll("-", " ");
}

export const LIVE_KEYS = /** @type {[string, string][]} */ ([
  ["W S, up down", "push and pull"], ["A D, left right", "turn"], ["space", "pause, continue"], ["N", "one step"],
  ["R", "start anew"], ["I", "select the next instrument"], ["gamepad", "left stick steers, A pauses, Y starts anew"],
  ["touch", "the round pad: up pushes, sideways turns"],
]);
