// @ts-check
import { brief } from "./colours.js";
import { Model } from "./model.js";
import { byId, make } from "./panel.js";
import { Recording } from "./recording.js";

/**
 * What the server says of the run, as viewer/live.py sends it.
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
 * @property {Record<string, number | string>} values the parameters that may be changed
 * @property {Record<string, string[]>} choices of those that are words
 */

/** Key to [what it drives, which way]. @type {Record<string, ["push" | "turn", number]>} */
const DRIVES = {
  w: ["push", 1], ArrowUp: ["push", 1], s: ["push", -1], ArrowDown: ["push", -1],
  d: ["turn", 1], ArrowRight: ["turn", 1], a: ["turn", -1], ArrowLeft: ["turn", -1],
};

/** A run that goes on in the runner. Here are only keys and pictures. */
export class Live {
  /** @param {import("./stage.js").Stage} stage @param {import("./panel.js").Panel} panel */
  constructor(stage, panel) {
    this._stage = stage;
    this._panel = panel;
    /** @type {Model | null} */
    this.model = null;
    /** @type {Status | null} */
    this.status = null;
    /** Frames that have come. */
    this.received = 0;
    /** Times from a key to the picture that shows what it did, ms. @type {number[]} */
    this.delays = [];
    this._held = new Set();
    /** Whether a value was sent that the server has not answered. */
    this._isSent = false;
    this._mark = 0;
    this._marks = new Map();
    this._newest = 0;
    stage.onDrawn = () => this._shown();
    this._socket = new WebSocket(new URL("live", location.href.replace(/^http/, "ws")));
    this._socket.binaryType = "arraybuffer";
    this._socket.onmessage = ({ data }) => (typeof data === "string" ? this._hear(JSON.parse(data)) : this._take(data));
    this._socket.onclose = ({ reason }) => panel.say([reason || "the server has ended: this page is no longer live"]);
    const leave = () => this._drive([]);
    addEventListener("blur", leave);
    document.addEventListener("visibilitychange", () => document.hidden && this.send({ do: "pause", value: true }));
    addEventListener("keyup", ({ key }) => {
      if (this._held.delete(key.length === 1 ? key.toLowerCase() : key)) this._tell();
    });
  }

  /** @param {object} message */
  send(message) {
    if (this._socket.readyState === WebSocket.OPEN) this._socket.send(JSON.stringify(message));
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether the key means something here */
  key(event) {
    if (event.key in DRIVES) {
      if (!event.repeat) this._drive([...this._held, event.key]);
    } else if (event.key === " ") this.send({ do: "pause", value: !this.status?.isPaused });
    else if (event.key === "n") this.send({ do: "step" });
    else if (event.key === "r") this.send({ do: "reset" });
    else return false;
    return true;
  }

  /** @param {string[]} keys that are down */
  _drive(keys) {
    this._held = new Set(keys);
    this._tell();
  }

  _tell() {
    const hand = { push: 0, turn: 0 };
    for (const key of this._held) hand[DRIVES[key][0]] += DRIVES[key][1];
    this._marks.set(++this._mark, performance.now());
    this.send({ do: "hand", push: Math.sign(hand.push), turn: Math.sign(hand.turn), mark: this._mark });
  }

  /** @param {Status} status */
  async _hear(status) {
    const isNew = this.status?.opened !== status.opened;
    const wasHand = this.status?.hand;
    this.status = status;
    if (isNew) {
      const answer = await fetch(`recording/0?${status.opened}`);
      if (answer.ok) this._open(new Recording(await answer.arrayBuffer()));
    }
    if (isNew || wasHand !== status.hand || status.hand) this._makeControls(status);
    this._panel.say([status.problem, status.outcome, ...(this.model?.recording.warnings ?? [])].filter(Boolean));
  }

  /** @param {Recording} recording */
  _open(recording) {
    this.model?.dispose();
    const before = this.model?.recording.title;
    this.model = new Model(recording);
    this._stage.set([[this.model]]);
    this._panel.set([this.model], false);
    this.show();
    if (before !== recording.title) this._stage.frameAll(true);
    this._label();
  }

  /** @param {ArrayBuffer} data */
  _take(data) {
    const numbers = new Float64Array(data);
    this.received++;
    this._newest = numbers[0];
    this.send({ do: "shown" });
    if (!this.model) return;
    const { recording } = this.model;
    recording.append(numbers.subarray(1));
    this.model.frame = recording.count - 1;
    this.show();
    this._label();
  }

  /** Shows the newest frame with what is chosen beside it. */
  show() {
    if (!this.model) return;
    const { recording, frame } = this.model;
    this._panel.show([frame], recording.at("time", frame)[0]);
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
    this._stage.label(0, `${recording.title}\nt = ${brief(time)} s   step ${step}\n`
      + `${brief(stepTime)} ms a step: ${brief(rate)} times real time\n${this._mood()}`);
  }

  _mood() {
    if (!this.status) return "";
    if (!this.status.hand) return this.status.isFree ? "nobody is steering" : "watching: another page is steering";
    if (this.status.isPaused) return "paused";
    return this.status.isSteered ? "" : "moved by its file's drive";
  }

  /** @param {Status} status */
  _makeControls(status) {
    const button = (/** @type {string} */ text, /** @type {object} */ message) =>
      make("button", { onclick: () => this.send(message) }, text);
    const leave = () => this._drive([]);
    const held = (/** @type {string} */ text, /** @type {string} */ key) =>
      make("button", { onpointerdown: () => this._drive([key]), onpointerup: leave, onpointerleave: leave }, text);
    const scenes = make("select", { id: "scenes", onchange: () => this.send({ do: "open", scene: scenes.value }) },
      ...status.scenes.map((scene) => make("option", { value: scene, selected: scene === status.scene }, scene)));
    const paces = make("select", { id: "pace", onchange: () => this.send({ do: "pace", value: Number(paces.value) }) },
      ...status.paces.map((pace) =>
        make("option", { value: pace, selected: pace === status.pace }, `${pace} x real time`)));
    const isOurs = status.hand;
    byId("bar").replaceChildren(...(isOurs ? [
      ...(status.isSteered
        ? [held("push", "w"), held("pull", "s"), held("turn left", "a"), held("turn right", "d")] : []),
      button(status.isPaused ? "go on" : "pause", { do: "pause", value: !status.isPaused }),
      button("step", { do: "step" }), button("start anew", { do: "reset" }),
      button(status.isSteered ? "file's drive" : "interactive",
        { do: "open", scene: status.scene, hand: !status.isSteered }), paces, scenes,
    ] : [button("take control", { do: "take" })]));
    const typed = byId("controls").contains(document.activeElement) ? document.activeElement : null;
    if (typed && !this._isSent) return; // a value that is being typed
    this._isSent = false;
    byId("controls").replaceChildren(...(isOurs ? Object.entries(status.values).map(([key, value]) => {
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

export const LIVE_KEYS = `W, S or up, down  push, pull
A, D or left, right  turn
space  pause
N  one step
R  start anew`;
