// @ts-check
import { View } from "./look.js";
import { Pieces, NUMBERS } from "./pieces.js";

/** @typedef {import("./pieces.js").Instrument} Instrument */

/** X-ray pictures without WebGL: vessel and background by the formula of the core, instruments as strokes of even
 * opacity, without noise. */
export class PlainFluoroscopy extends View {
  /** @param {HTMLCanvasElement} canvas @param {number} pixels of a side */
  constructor(canvas, pixels) {
    super(canvas);
    this._pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    this._pieces = new Pieces();
    this._image = new ImageData(1, 1);
    this.resize(pixels, pixels);
  }

  /** @param {[Instrument, ArrayLike<number>][]} instruments with the points of their centrelines, units; dark always */
  draw(instruments) {
    const { arm, _pen: pen } = this;
    if (this._setBrightness(arm)) {
      this._image = new ImageData(this.columns, this.rows);
      const words = new Uint32Array(this._image.data.buffer);
      this._brightness.forEach((value, k) => {
        words[k] = 0xff000000 | (0x010101 * Math.round(255 * Math.max(0, Math.min(1, value))));
      });
    }
    pen.putImageData(this._image, 0, 0);
    this._pieces.clear();
    for (const [instrument, x] of instruments) this._pieces.add(instrument, x, arm);
    for (let k = 0; k < this._pieces.count; k++) {
      const [x, y, ux, uy, length, , , r, , perChord, even] = this._pieces.numbers.subarray(NUMBERS * k, NUMBERS * (k + 1));
      const width = Math.max(1, 2 * r);
      const depth = (perChord * 0.5 * Math.PI * r + even) * Math.min(1, 2 * r);
      pen.strokeStyle = `rgba(0, 0, 0, ${1 - Math.exp(-depth)})`;
      pen.lineWidth = width;
      pen.beginPath();
      pen.moveTo(x, y);
      pen.lineTo(x + length * ux, y + length * uy);
      pen.stroke();
    }
  }
}
