// @ts-check
import { brief } from "./colours.js";
import { Model } from "./model.js";
import { byId, make, named } from "./panel.js";
import { say } from "./words.js";

/** @typedef {import("./recording.js").Recording} Recording */

const SPEEDS = [0.001, 0.01, 0.1, 0.25, 0.5, 1, 2, 5, 10]; // of real time
const SECONDS = 8; // that a replay takes at most as it begins

/** One run that has ended, or two, at the same moment of their own time. */
export class Replay {
  /**
   * @param {import("./stage.js").Stage} stage
   * @param {import("./panel.js").Panel} panel
   * @param {import("./desk.js").Desk} desk
   * @param {import("./xray.js").Xray} xray
   * @param {Recording[]} recordings
   */
  constructor(stage, panel, desk, xray, recordings) {
    this._stage = stage;
    this._panel = panel;
    this._desk = desk;
    this._xray = xray;
    recordings.forEach((recording, k) => recording.recolour(k));
    this.models = recordings.map((recording) => new Model(recording));
    this.isPlaying = false;
    this.areOver = false;
    this.time = this._times(0)[0];
    this._end = Math.max(...recordings.map((_, k) => this._times(k).at(-1) ?? 0));
    this._slider = named("input", "time", { type: "range", min: 0, max: 1, step: "any", value: 0, id: "slider" });
    this._slider.oninput = () => this.go(this._start + Number(this._slider.value) * (this._end - this._start));
    const speeds = SPEEDS.map((speed) => make("option", { value: speed }, `${speed} x`));
    this._speed = named("select", "speed", { id: "speed" }, ...speeds);
    const whole = this._end - this._start;
    this._speed.value = SPEEDS.find((speed) => whole / speed <= SECONDS) ?? SPEEDS.at(-1);
    const button = (/** @type {string} */ text, /** @type {() => void} */ onclick, /** @type {string} */ name) =>
      named("button", name, { onclick }, text);
    this._play = make("button", { onclick: () => this.play(!this.isPlaying) }, "play");
    this._over = make("button", { onclick: () => this.arrange(!this.areOver) });
    if (recordings.length > 1) document.body.dataset.views = "space";
    byId("bar").replaceChildren(button("|<", () => this.go(this._start), "to the start"),
      button("<", () => this.step(-1), "previous frame"), this._play, button(">", () => this.step(1), "next frame"),
      this._slider, this._speed,
      ...(recordings.length > 1 ? [this._over] : []));
    this.arrange(false);
  }

  get _start() {
    return Math.min(...this.models.map((_, k) => this._times(k)[0]));
  }

  /** Frames shown now, one a run. */
  get frames() {
    return this.models.map(({ recording }) => recording.nearest(this.time));
  }

  /** Side by side, or superimposed. @param {boolean} areOver */
  arrange(areOver) {
    this.areOver = areOver;
    this._over.textContent = say(areOver ? "side by side" : "superimposed");
    this._stage.set(areOver ? [this.models] : this.models.map((model) => [model]));
    this._panel.set(this.models, areOver);
    this._desk.set(this.models.map(({ recording }) => recording));
    this._xray.set(this.models);
    this.show();
    this._stage.frameAll(true);
  }

  /** Goes to a moment. @param {number} time s */
  go(time) {
    this.time = Math.min(Math.max(time, this._start), this._end);
    this.show();
  }

  /** Goes on by single frames of the first run. @param {number} frames */
  step(frames) {
    this.play(false);
    const times = this._times(0);
    this.go(times[Math.min(Math.max(this.models[0].recording.nearest(this.time) + frames, 0), times.length - 1)]);
  }

  /** @param {boolean} isPlaying */
  play(isPlaying) {
    this.isPlaying = isPlaying;
    this._play.textContent = say(isPlaying ? "pause" : "play");
    if (!isPlaying) return;
    if (this.time >= this._end) this.time = this._start;
    let before = performance.now();
    const go = (/** @type {number} */ now) => {
      if (!this.isPlaying) return;
      this.go(this.time + ((now - before) / 1000) * Number(this._speed.value));
      before = now;
      if (this.time >= this._end) this.play(false);
      else requestAnimationFrame(go);
    };
    requestAnimationFrame(go);
  }

  /** Shows the frames of this moment. */
  show() {
    this._slider.value = String((this.time - this._start) / (this._end - this._start || 1));
    const { frames } = this;
    this._panel.show(frames);
    this._desk.show(frames[0]);
    this._xray.ask();
    byId("title").textContent = this.models.map(({ recording }) => recording.title).join(" and ");
    document.title = `${byId("title").textContent} · Guidewire`;
    byId("mood").textContent = say(this.isPlaying ? "replay" : "replay, paused");
    const texts = this.models.map(({ recording }, k) =>
      `${recording.title}\nt = ${brief(this._times(k)[frames[k]])} s   step ${recording.at("step", frames[k])[0]}`);
    if (this.areOver) this._stage.label(0, `${texts[0]}\norange: ${texts[1]}`);
    else texts.forEach((text, k) => this._stage.label(k, text));
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether the key means something here */
  key(event) {
    if (event.key === " ") this.play(!this.isPlaying);
    else if (event.key === "ArrowRight" || event.key === "n") this.step(1);
    else if (event.key === "ArrowLeft") this.step(-1);
    else if (event.key === "r") this.go(this._start);
    else return false;
    return true;
  }

  /** @param {number} k */
  _times(k) {
    return this.models[k].recording.overTime("time");
  }
}

export const REPLAY_KEYS = /** @type {[string, string][]} */ ([
  ["space", "play, pause"], ["left right", "single frames"], ["R", "to the start"],
]);
