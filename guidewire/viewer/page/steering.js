// @ts-check
/** Key to [what it drives, which way]. @type {Record<string, ["push" | "turn", number]>} */
const DRIVES = {
  w: ["push", 1], ArrowUp: ["push", 1], s: ["push", -1], ArrowDown: ["push", -1],
  d: ["turn", 1], ArrowRight: ["turn", 1], a: ["turn", -1], ArrowLeft: ["turn", -1],
};
const DEAD_ZONE = 0.15; // of a stick's travel
const STEPS = 50; // of a stick from 0 to 1: a message is sent where it is at another
const PAD_BUTTONS = { 0: "pause", 3: "reset" };

/** What keys, held buttons, a touch pad and a gamepad ask for: push and turn from -1 to 1. */
export class Steering {
  /**
   * @param {(push: number, turn: number) => void} onChange called where that has changed
   * @param {(button: string) => void} pressed "pause" or "reset" of a gamepad
   */
  constructor(onChange, pressed) {
    this._onChange = onChange;
    this._pressed = pressed;
    /** @type {Set<string>} */
    this._held = new Set();
    this._touch = [0, 0];
    this._pad = [0, 0];
    /** @type {Set<number>} */
    this._padButtons = new Set();
    this.push = 0;
    this.turn = 0;
    addEventListener("blur", () => this.release());
    addEventListener("keyup", ({ key }) => {
      if (this._held.delete(key.length === 1 ? key.toLowerCase() : key)) this._update();
    });
    addEventListener("gamepadconnected", () => this._poll());
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether it steers */
  key(event) {
    if (!(event.key in DRIVES)) return false;
    if (!event.repeat) this.hold(event.key);
    return true;
  }

  /** @param {string} key as if it were held */
  hold(key) {
    this._held.add(key);
    this._update();
  }

  /** Lets go of everything. */
  release() {
    this._held.clear();
    this._touch = [0, 0];
    this._update();
  }

  /** A finger on a pad: up pushes, right turns clockwise. @param {HTMLElement} pad */
  listen(pad) {
    const move = (/** @type {PointerEvent} */ event) => {
      const box = pad.getBoundingClientRect();
      const part = (/** @type {number} */ at, /** @type {number} */ low, /** @type {number} */ size) =>
        limited((2 * (at - low)) / size - 1);
      this._touch = [-part(event.clientY, box.top, box.height), part(event.clientX, box.left, box.width)]
        .map((value) => (Math.abs(value) < DEAD_ZONE ? 0 : value));
      pad.style.setProperty("--x", String(this._touch[1]));
      pad.style.setProperty("--y", String(-this._touch[0]));
      this._update();
    };
    pad.addEventListener("pointerdown", (event) => {
      pad.setPointerCapture(event.pointerId);
      move(event);
    });
    pad.addEventListener("pointermove", (event) => event.buttons && move(event));
    for (const end of ["pointerup", "pointercancel"]) {
      pad.addEventListener(end, () => {
        this._touch = [0, 0];
        pad.style.setProperty("--x", "0");
        pad.style.setProperty("--y", "0");
        this._update();
      });
    }
  }

  /** Reads gamepads for as long as there is one. */
  _poll() {
    const pad = [...navigator.getGamepads()].find((one) => one?.connected);
    const stick = (/** @type {number} */ axis) => {
      const value = pad?.axes[axis] ?? 0;
      return Math.abs(value) < DEAD_ZONE ? 0 : Math.round(limited(value) * STEPS) / STEPS;
    };
    this._pad = [-stick(1), stick(0)];
    this._update();
    for (const [index, name] of Object.entries(PAD_BUTTONS)) {
      const isDown = pad?.buttons[Number(index)]?.pressed ?? false;
      if (isDown && !this._padButtons.has(Number(index))) this._pressed(name);
      this._padButtons[isDown ? "add" : "delete"](Number(index));
    }
    if (pad) requestAnimationFrame(() => this._poll());
  }

  _update() {
    const keys = { push: 0, turn: 0 };
    for (const key of this._held) keys[DRIVES[key][0]] += DRIVES[key][1];
    const push = limited(Math.sign(keys.push) + this._touch[0] + this._pad[0]);
    const turn = limited(Math.sign(keys.turn) + this._touch[1] + this._pad[1]);
    if (push === this.push && turn === this.turn) return;
    [this.push, this.turn] = [push, turn];
    this._onChange(push, turn);
  }
}

/** @param {number} value */
function limited(value) {
  return Math.max(-1, Math.min(1, value));
}
