// @ts-check
import { make, named } from "./panel.js";
import { note } from "./sounds.js";

const MOST = 150; // pictures of a cine loop
const RATES = /** @type {[string, number][]} */ ([["continuous", Infinity], ["30 a second", 30], ["15 a second", 15],
  ["7.5 a second", 7.5]]);

const CONTINUOUS = 30; // pictures a second that a continuous beam is counted as

/** The pedal: whether there is a beam, how often a second, and what has come of it. */
export class Beam {
  /** @param {() => void} changed called where a picture may be due */
  constructor(changed) {
    this._changed = changed;
    this.isOn = true;
    /** s of the run with the beam on. */
    this.seconds = 0;
    /** Pictures of the run that the beam's pulses made, however many of them this computer has drawn. */
    this.pictures = 0;
    /** Times of the run between which it was on, s. @type {[number, number][]} */
    this.spans = [];
    this._rate = Infinity;
    this._last = -Infinity; // ms
    this._time = NaN; // s of the run
    this.button = named("button", "beam", { id: "pedal", onclick: () => this.set(!this.isOn), title: "pedal (key X)" }, "☢ ",
      make("span", { className: "wide" }, "beam"));
    this.rates = named("select", "pulses of the beam", { id: "pulses", onchange: () => {
      this._rate = RATES[this.rates.selectedIndex][1];
      changed();
    } }, ...RATES.map(([text]) => make("option", {}, text)));
    this.set(true);
  }

  /** Another run: nothing was taken yet. */
  restart() {
    [this.seconds, this.pictures, this._time, this.spans] = [0, 0, NaN, []];
  }

  /** @param {boolean} isOn */
  set(isOn) {
    if (isOn !== this.isOn) note(isOn ? 660 : 440, 0.1);
    this.isOn = isOn;
    this.button.setAttribute("aria-pressed", String(isOn));
    this._changed();
  }

  /** ms until the next picture is due, where there is a beam. */
  get wait() {
    return Math.max(0, this._last + 1000 / this._rate - performance.now());
  }

  /** A picture is taken. @param {number} time s of the run */
  take(time) {
    this._last = performance.now();
    this.pass(time);
  }

  /** The run goes on. @param {number} time s */
  pass(time) {
    if (time <= this._time) return; // one looks back
    const seconds = this.isOn ? time - this._time || 0 : 0;
    const last = this.spans.at(-1);
    if (seconds && last?.[1] === this._time) last[1] = time;
    else if (seconds) this.spans.push([this._time, time]);
    this.seconds += seconds;
    this.pictures += seconds * Math.min(this._rate, CONTINUOUS);
    this._time = time;
  }
}

/** A loop of pictures that were taken, over the picture of now. */
export class Cine {
  /** @param {HTMLCanvasElement} canvas that shows it */
  constructor(canvas) {
    this._canvas = canvas;
    /** @type {ImageBitmap[]} */
    this._pictures = [];
    this.isRecording = this.isShown = false;
    this.record = make("button", { id: "record", onclick: () => this._record(!this.isRecording) }, "record cine");
    this._slider = named("input", "picture of the cine loop", { type: "range", min: 0, step: 1, value: 0, oninput: () => this._show(Number(this._slider.value)) });
    this.loop = make("button", { id: "loop", onclick: () => this._play(!this.isShown) }, "cine loop");
    this._bar = make("span", { className: "tools", id: "cineBar" }, this._slider);
    this.element = make("span", { className: "tools" }, this.record, this.loop, this._bar);
    this._record(false);
    this._play(false);
  }

  /** @param {boolean} isRecording */
  _record(isRecording) {
    if (isRecording) {
      this._pictures.splice(0).forEach((picture) => picture.close());
      this._play(false);
    }
    this.isRecording = isRecording;
    this.record.setAttribute("aria-pressed", String(isRecording));
    this.loop.disabled = !this._pictures.length;
  }

  /** A picture was drawn. @param {HTMLCanvasElement} drawn */
  async take(drawn) {
    if (!this.isRecording) return;
    const picture = await createImageBitmap(drawn);
    this._pictures.push(picture);
    if (this._pictures.length > MOST) this._pictures.shift()?.close();
    this.loop.disabled = false;
    this._slider.max = this._pictures.length - 1;
  }

  /** How many pictures there are. */
  get count() {
    return this._pictures.length;
  }

  /** @param {boolean} isShown */
  _play(isShown) {
    this.isShown = isShown && this._pictures.length > 0;
    this.loop.setAttribute("aria-pressed", String(this.isShown));
    this._bar.hidden = this._canvas.hidden = !this.isShown;
    clearInterval(this._timer);
    if (!this.isShown) return;
    this.isRecording = false;
    this.record.setAttribute("aria-pressed", "false");
    this._show(0);
    this._timer = setInterval(() => {
      if (this._canvas.hidden) return;
      this._show((Number(this._slider.value) + 1) % this._pictures.length);
    }, 1000 / 15);
    this._slider.onpointerdown = () => clearInterval(this._timer);
  }

  /** @param {number} at */
  _show(at) {
    const picture = this._pictures[at];
    if (!picture) return;
    this._slider.value = String(at);
    [this._canvas.width, this._canvas.height] = [picture.width, picture.height];
    this._canvas.getContext("2d")?.drawImage(picture, 0, 0);
  }
}
