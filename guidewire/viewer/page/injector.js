// @ts-check
import { byId, make, named } from "./panel.js";
import { note } from "./sounds.js";
import { whileHeld } from "./steering.js";
import { fixed, say } from "./words.js";

/**
 * @typedef {{agent: {parts: string, injected: number, held: number, isActive: boolean, isInjecting: boolean}}} Told what
 *     contrast agent is where: parts of the blood in each cell, base64 of doubles; ml
 */

const MOST = 200; // ml, as live.py takes it
const INLET = "where blood comes in";
const BY_HAND = "by hand";

/** Injects contrast agent: by a pump an amount at once, by hand for as long as a key or button is held. */
export class Injector {
  /** @param {(message: Record<string, any>) => void} send */
  constructor(send) {
    this._send = send;
    /** ml so far. */
    this.injected = 0;
    this._isDown = false;
    this._amount = make("input", { type: "number", min: 0.1, max: MOST, step: "any", value: 6, required: true });
    this._rate = make("input", { type: "number", min: 0.1, max: 50, step: "any", value: 3, required: true });
    this._how = named("select", "injection", {}, make("option", { value: "" }, "by pump"), make("option", { value: BY_HAND }, BY_HAND));
    this._where = named("select", "place of injection", {});
    this._said = make("output", {});
    this._element = make("div", { className: "card", id: "contrast" },
      make("div", { className: "line" }, make("span", {}, "contrast injected"), this._said),
      make("div", { className: "fields" }, this._where, this._how, make("label", {}, this._amount, " ml"),
        make("label", {}, this._rate, " ml/s")));
  }

  /** Another case: nothing is injected yet. @param {import("./recording.js").Recording} recording
   * @param {boolean} goesOn whether it is the same with another instrument */
  set(recording, goesOn) {
    this._hasVessel = Boolean(recording.described?.cells);
    if (!goesOn) this.injected = 0;
    this._show();
    const places = [...recording.instruments.map(({ name }) => say("tip of {0}", name)), INLET];
    this._where.replaceChildren(...places.map((place) => make("option", {}, place)));
    this._where.selectedIndex = places.length - 1;
    byId("desk").querySelector("#legend")?.before(this._element);
    this._element.hidden = !this._hasVessel;
  }

  /** Whether blood is known to flow, into which to inject. */
  get isUseful() {
    return Boolean(this._hasVessel);
  }

  /** The button, for those who have no key. */
  get button() {
    const button = make("button", { id: "inject", ...whileHeld(() => this.press(), () => this.release()) }, "inject ", make("kbd", {}, "E"));
    button.disabled = !this._hasVessel;
    button.title = say(this._hasVessel ? "contrast into the blood" : "this vessel has no centreline along which blood could flow");
    return button;
  }

  /** Begins an injection. */
  press() {
    if (!this._hasVessel || this._isDown) return;
    const isByHand = this._how.value === BY_HAND;
    if (!(isByHand || this._amount.reportValidity()) || !this._rate.reportValidity()) return;
    this._isDown = true;
    note(300, 0.4);
    const last = this._where.options.length - 1;
    this._send({ do: "inject", amount: isByHand ? MOST : Number(this._amount.value), rate: Number(this._rate.value),
      instrument: this._where.selectedIndex === last ? null : this._where.selectedIndex });
  }

  /** Ends one that is made by hand. */
  release() {
    if (!this._isDown) return;
    this._isDown = false;
    if (this._how.value === BY_HAND) this._send({ do: "inject", amount: 0, rate: 1, instrument: null });
  }

  /** @param {Told["agent"]} agent @returns {Float64Array | null} parts of the blood in the cells; null: none */
  take({ parts, injected, isActive }) {
    this.injected = injected;
    this._show();
    return isActive ? new Float64Array(Uint8Array.from(atob(parts), (one) => one.charCodeAt(0)).buffer) : null;
  }

  _show() {
    this._said.textContent = `${fixed(this.injected, 1)} ml`;
  }
}
