// @ts-check
import { byId } from "./panel.js";

/** @typedef {import("./look.js").View} View */
/** @typedef {import("./fluoroscopy.js").Fluoroscopy} Fluoroscopy */
/** @typedef {import("./plain.js").PlainFluoroscopy} PlainFluoroscopy */

const APART = 90; // degrees between the two planes

/** The second plane of a biplane C-arm: the same, from 90 degrees farther left, in place of the 3D picture. */
export class SecondPlane {
  /** @param {(canvas: HTMLCanvasElement) => Fluoroscopy | PlainFluoroscopy} make a picture */
  constructor(make) {
    this._make = make;
    /** @type {Fluoroscopy | PlainFluoroscopy | null} */
    this._fluoroscopy = null;
    /** @type {Parameters<View["set"]> | null} */
    this._seen = null;
  }

  get isShown() {
    return document.body.dataset.views === "biplane";
  }

  /** @param {Parameters<View["set"]>} seen as the first plane has it */
  set(...seen) {
    this._seen = seen;
    this._fluoroscopy?.set(...seen);
  }

  /**
   * @param {View} first @param {[import("./pieces.js").Instrument, ArrayLike<number>][]} instruments
   */
  draw(first, instruments) {
    if (!this.isShown || !this._seen) return;
    if (!this._fluoroscopy) {
      this._fluoroscopy = this._make(byId("secondPlane"));
      this._fluoroscopy.set(...this._seen);
    }
    this._fluoroscopy.fit(byId("view"));
    const lao = ((first.look.lao + APART + 180) % 360) - 180;
    this._fluoroscopy.look = { ...first.look, lao, seed: first.look.seed + 1, isSubtracted: false };
    this._fluoroscopy.parts = first.parts;
    this._fluoroscopy.moves = first.moves;
    this._fluoroscopy.middles = first.middles;
    this._fluoroscopy.showsPatient = first.showsPatient;
    this._fluoroscopy.draw(instruments, !byId("measured").checked);
    byId("secondArm").textContent = `second plane, ${this._fluoroscopy.angles[0]}`;
  }
}
