// @ts-check
/** Key to [what it drives, which way]; the second four drive the other instrument.
 * @type {Record<string, ["push" | "turn" | "otherPush" | "otherTurn", number]>} */
const DRIVES = {
  w: ["push", 1], ArrowUp: ["push", 1], s: ["push", -1], ArrowDown: ["push", -1],
  d: ["turn", 1], ArrowRight: ["turn", 1], a: ["turn", -1], ArrowLeft: ["turn", -1],
  u: ["otherPush", 1], j: ["otherPush", -1], l: ["otherTurn", 1], k: ["otherTurn", -1],
};
const FINE = 0.2; // of the speed
const DEAD_ZONE = 0.15; // of a stick's travel
const STEPS = 50; // of a stick from 0 to 1: a message is sent where it is at another
const PAD_BUTTONS = { 0: "pause", 1: "inject", 2: "fine", 3: "reset", 4: "hold", 5: "beam", 12: "exchange" };

/** What a button hears that acts for as long as it is pressed, by a pointer, Enter or the space bar.
 * @param {() => void} press @param {() => void} release */
export function whileHeld(press, release) {
  const isKey = (/** @type {KeyboardEvent} */ { key }) => key === "Enter" || key === " ";
  return { onpointerdown: press, onpointerup: release, onpointerleave: release,
    onkeydown: (/** @type {KeyboardEvent} */ event) => isKey(event) && !event.repeat && press(),
    onkeyup: (/** @type {KeyboardEvent} */ event) => isKey(event) && release() };
}

/** What keys, held buttons, a touch pad and a gamepad ask for: push and turn of both hands from -1 to 1. */
export class Steering {
  /**
   * @param {(push: number, turn: number, otherPush: number, otherTurn: number) => void} onChange called where that has
   *     changed
   * @param {(button: string) => void} pressed "pause" or "reset" of a gamepad
   */
  constructor(onChange, pressed) {
    this._onChange = onChange;
    this._pressed = pressed;
    /** @type {Set<string>} */
    this._held = new Set();
    this._touch = [0, 0];
    this._pad = [0, 0, 0, 0];
    /** Whether all goes slowly. */
    this.isFine = false;
    this.otherPush = this.otherTurn = 0;
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

  /** @param {boolean} isFine whether all goes slowly */
  refine(isFine) {
    this.isFine = isFine;
    this._update();
  }

  /** Lets go of everything. */
  release() {
    this._held.clear();
    this._touch = [0, 0];
    this._update();
  }

  /** A finger on a pad that pushes (up) or turns (right is clockwise). @param {HTMLElement} pad @param {number} axis 0: it
   * pushes; 1: it turns */
  listen(pad, axis) {
    const take = (/** @type {number} */ value) => {
      this._touch[axis] = Math.abs(value) < DEAD_ZONE ? 0 : value;
      pad.style.setProperty(axis ? "--x" : "--y", String(axis ? value : -value));
      this._update();
    };
    const move = (/** @type {PointerEvent} */ event) => {
      const { left, top, width, height } = pad.getBoundingClientRect();
      take(limited(axis ? (2 * (event.clientX - left)) / width - 1 : 1 - (2 * (event.clientY - top)) / height));
    };
    pad.addEventListener("pointerdown", (event) => {
      pad.setPointerCapture(event.pointerId);
      move(event);
    });
    pad.addEventListener("pointermove", (event) => event.buttons && move(event));
    for (const end of ["pointerup", "pointercancel"]) pad.addEventListener(end, () => take(0));
  }

  /** Reads gamepads for as long as there is one. */
  _poll() {
    const pad = [...navigator.getGamepads()].find((one) => one?.connected);
    const stick = (/** @type {number} */ axis) => {
      const value = pad?.axes[axis] ?? 0;
      return Math.abs(value) < DEAD_ZONE ? 0 : Math.round(limited(value) * STEPS) / STEPS;
    };
    this._pad = [-stick(1), stick(0), -stick(3), stick(2)];
    this._update();
    for (const [index, name] of Object.entries(PAD_BUTTONS)) {
      const isDown = pad?.buttons[Number(index)]?.pressed ?? false;
      if (isDown && !this._padButtons.has(Number(index))) this._pressed(name);
      this._padButtons[isDown ? "add" : "delete"](Number(index));
    }
    if (pad) requestAnimationFrame(() => this._poll());
  }

  _update() {
    const keys = { push: 0, turn: 0, otherPush: 0, otherTurn: 0 };
    for (const key of this._held) keys[DRIVES[key][0]] += DRIVES[key][1];
    const speed = this.isFine ? FINE : 1;
    const [push, turn, otherPush, otherTurn] = [Math.sign(keys.push) + this._touch[0] + this._pad[0],
      Math.sign(keys.turn) + this._touch[1] + this._pad[1], Math.sign(keys.otherPush) + this._pad[2],
      Math.sign(keys.otherTurn) + this._pad[3]].map((value) => speed * limited(value));
    if (push === this.push && turn === this.turn && otherPush === this.otherPush && otherTurn === this.otherTurn) return;
    Object.assign(this, { push, turn, otherPush, otherTurn });
    this._onChange(push, turn, otherPush, otherTurn);
  }
}

/** @param {number} value */
function limited(value) {
  return Math.max(-1, Math.min(1, value));
}
