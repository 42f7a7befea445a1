// @ts-check
/** Tells a first visitor, in one bubble at the wire's tip, to push, then to turn; never again once both were done. */
import { byId, make } from "./panel.js";
import { say } from "./words.js";

const DONE = "guidewire-coached=1"; // a cookie, since each run of the server has an address of its own
const TOOLS = 84; // points of the picture's foot that its tools take
const HELD = 0.3; // s of the run for which a hand has to do what is asked

/** What is asked, by which keys, with which part of the pads, and what for.
 * @type {["push" | "turn", string[], string, string][]} */
const STEPS = [["push", ["W"], "the upper edge of the push pad", "to push the wire."],
  ["turn", ["A", "D"], "a side of the turn pad", "to turn its tip."]];

export class Coach {
  /** @param {import("./xray.js").Xray} xray */
  constructor(xray) {
    this._xray = xray;
    this._step = document.cookie.includes(DONE) ? STEPS.length : 0;
    this._done = 0; // s
    this._bubble = make("div", { id: "coach", hidden: true });
    this._bubble.setAttribute("role", "status");
    byId("xray").append(this._bubble);
  }

  /** @param {boolean} isSteered whether this page steers the wire by hand */
  offer(isSteered) {
    const step = isSteered ? STEPS[this._step] : undefined;
    this._bubble.hidden = !step;
    if (!step || this._bubble.dataset.step === String(this._step)) return;
    this._bubble.dataset.step = String(this._step);
    const [, keys, pad, aim] = step;
    this._bubble.replaceChildren(say("Hold"), " ",
      make("span", { className: "byKey" }, ...keys.flatMap((key, k) => [k ? "/" : "", make("kbd", {}, key)])),
      make("span", { className: "byPad" }, pad), " ", make("strong", {}, aim), make("div", { className: "line" },
        say("{0} of {1}", this._step + 1, STEPS.length), make("button", { onclick: () => this._end() }, "skip")));
  }

  /** The run went on while a hand steered. @param {{push: number, turn: number}} steering @param {number} seconds */
  pass(steering, seconds) {
    const step = STEPS[this._step];
    if (!step || this._bubble.hidden || !(seconds > 0)) return;
    if (step[0] === "push" ? steering.push > 0 : steering.turn !== 0) this._done += seconds;
    if (this._done < HELD) return;
    [this._done, this._step] = [0, this._step + 1];
    if (this._step === STEPS.length) this._end();
    else this.offer(true);
  }

  /** Puts the bubble beside the tip, inside of the picture. @param {ArrayLike<number>} tip units */
  place(tip) {
    const { arm, canvas } = this._xray.fluoroscopy;
    if (this._bubble.hidden || !this._xray.arm) return;
    const [x, y] = arm.project(tip, 0, [0, 0, 0]);
    const within = (/** @type {number} */ at, /** @type {number} */ most) => Math.max(8, Math.min(at, most - 8));
    const { offsetWidth, offsetHeight } = this._bubble;
    this._bubble.style.left = `${within((x / arm.columns) * canvas.clientWidth + 24, canvas.clientWidth - offsetWidth)}px`;
    this._bubble.style.top = `${within((y / arm.rows) * canvas.clientHeight - offsetHeight - 24,
      canvas.clientHeight - offsetHeight - TOOLS)}px`;
  }

  _end() {
    this._step = STEPS.length;
    this._bubble.hidden = true;
    document.cookie = `${DONE}; max-age=${10 * 365 * 86400}; path=/; SameSite=Strict`;
  }
}
