// @ts-check
import { Fluoroscopy } from "./fluoroscopy.js";
import { byId } from "./panel.js";

const APART = 90; // degrees between the two planes

/** The second plane of a biplane C-arm: the same, from 90 degrees farther left, in place of the 3D picture. */
export class SecondPlane {
  constructor() {
    /** @type {Fluoroscopy | null} */
    this._fluoroscopy = null;
    /** @type {Parameters<Fluoroscopy["set"]> | null} */
    this._seen = null;
  }

  get isShown() {
    return document.body.dataset.views === "biplane";
  }

  /** @param {Parameters<Fluoroscopy["set"]>} seen as the first plane has it */
  set(...seen) {
    this._seen = seen;
    this._fluoroscopy?.set(...seen);
  }

  /**
   * @param {import("./look.js").View} first @param {[import("./pieces.js").Instrument, ArrayLike<number>][]} instruments
   */
  draw(first, instruments) {
    if (!this.isShown || !this._seen) return;
    if (!this._fluoroscopy) {
      this._fluoroscopy = new Fluoroscopy(byId("secondPlane"), 512);
      this._fluoroscopy.set(...this._seen);
    }
    const { clientWidth: width, clientHeight: height } = byId("view");
    const shape = Math.sqrt(width / height);
    this._fluoroscopy.resize(Math.round(512 * shape), Math.round(512 / shape));
    const lao = ((first.look.lao + APART + 180) % 360) - 180;
    this._fluoroscopy.look = { ...first.look, lao, seed: first.look.seed + 1, isSubtracted: false };
    this._fluoroscopy.parts = first.parts;
    this._fluoroscopy.draw(instruments);
    byId("secondArm").textContent = `second plane, ${lao < 0 ? "RAO" : "LAO"} ${Math.abs(Math.round(lao))}°`;
  }
}
