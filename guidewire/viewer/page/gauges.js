// @ts-check
import { brief } from "./colours.js";
import { make, named } from "./panel.js";
import { newtons } from "./score.js";
import { say } from "./words.js";

const BANDS = ["good", "caution", "stop"];
const WORDS = ["normal", "caution", "too high"];

/** A bar with the bands of its limits: green, yellow, red. */
export class Gauge {
  /** @param {string} label @param {number[] | null} limits caution and stop, in the unit; null: no bands */
  constructor(label, limits) {
    this._limits = limits;
    this._most = limits ? 1.5 * limits[1] : 0;
    this._value = make("output", {});
    this._word = make("span", { className: "word" });
    this._peak = make("i", { className: "peak" });
    this._bar = make("i", { className: "fill" });
    this.element = named("div", label, { className: "gauge" }, make("span", { className: "label" }, label), this._value,
      this._word, make("div", { className: limits ? "bar bands" : "bar" }, this._bar, this._peak));
    this.element.setAttribute("role", "meter");
    for (const [name, value] of [["min", 0], ["max", 1], ["now", 0]]) this.element.setAttribute(`aria-value${name}`, String(value));
    if (limits) {
      this.element.style.setProperty("--caution-at", `${(100 * limits[0]) / this._most}%`);
      this.element.style.setProperty("--stop-at", `${(100 * limits[1]) / this._most}%`);
    }
  }

  /** @param {number} value NaN: not known @param {string} unit @param {number} peak the largest so far */
  show(value, unit, peak) {
    const isKnown = Number.isFinite(value);
    this.element.hidden = !isKnown;
    if (!isKnown) return;
    const most = this._limits ? this._most : Math.max(peak, 1e-12);
    const size = Math.abs(value);
    const band = this._limits ? Number(size >= this._limits[0]) + Number(size >= this._limits[1]) : 0;
    this._value.textContent = unit === "N" ? newtons(value) : brief(value, 3);
    this.element.title = unit === "N" ? "" : `unit: ${unit}`;
    this._word.textContent = this._limits ? say(WORDS[band]) : say("largest {0}", unit === "N" ? newtons(peak) : brief(peak, 3));
    this.element.dataset.band = BANDS[band];
    this._bar.style.width = `${Math.min(100, (100 * size) / most)}%`;
    this._peak.style.left = `${Math.min(100, (100 * peak) / most)}%`;
    this.element.setAttribute("aria-valuemax", most.toFixed(9)); // no reader takes an exponent
    this.element.setAttribute("aria-valuenow", Math.min(size, most).toFixed(9));
    this.element.setAttribute("aria-valuetext", `${this._value.textContent}, ${this._word.textContent}`);
  }
}

/** A round dial with a hand, and the number beside it. */
export class Dial {
  /** @param {string} label @param {(value: number) => number} angle rad of the hand, clockwise from above */
  constructor(label, angle) {
    this._angle = angle;
    this._hand = make("i", { className: "hand" });
    this._value = make("output", {});
    this.element = make("div", { className: "dial" }, make("div", { className: "face" }, this._hand),
      make("span", { className: "label" }, label), this._value);
    this.element.setAttribute("role", "img");
    this._label = say(label);
  }

  /** Lets a hand turn it, as a torque device. @param {() => number} now rad @param {(turn: number) => void} turned told
   * where it is to be */
  listen(now, turned) {
    const face = /** @type {HTMLElement} */ (this.element.firstChild);
    face.classList.add("turned");
    face.title = say("drag to turn");
    let [before, aim] = [0, 0];
    const angle = (/** @type {PointerEvent} */ { clientX, clientY }) => {
      const { left, top, width, height } = face.getBoundingClientRect();
      return Math.atan2(clientX - left - width / 2, top + height / 2 - clientY);
    };
    face.addEventListener("pointerdown", (event) => {
      face.setPointerCapture(event.pointerId);
      [before, aim] = [angle(event), now()];
    });
    face.addEventListener("pointermove", (event) => {
      if (!event.buttons) return;
      const here = angle(event);
      aim += Math.atan2(Math.sin(here - before), Math.cos(here - before));
      before = here;
      turned(aim);
    });
  }

  /** @param {number} value @param {string} text */
  show(value, text) {
    this.element.hidden = !Number.isFinite(value);
    this._value.textContent = text;
    this._hand.style.transform = `rotate(${this._angle(value) || 0}rad)`;
    this.element.setAttribute("aria-label", `${this._label}: ${text}`);
  }
}
