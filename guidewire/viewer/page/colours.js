// @ts-check
import { fixed } from "./words.js";

// Grey to red as in the pictures of guidewire/figures/render.py; where the sign counts, blue stands for values below zero.
const GREY = [0.82, 0.84, 0.88];
const RED = [0.95, 0.1, 0.05];
const BLUE = [0.1, 0.3, 0.95];
const STEPS = 256;

/** Colours in [0, 1], shape (256, 3), from the lowest value to the highest. @param {boolean} isSigned */
export function ramp(isSigned) {
  const colours = new Float32Array(3 * STEPS);
  for (let k = 0; k < STEPS; k++) {
    const level = isSigned ? (2 * k) / (STEPS - 1) - 1 : k / (STEPS - 1);
    for (let part = 0; part < 3; part++) {
      const far = level < 0 ? BLUE[part] : RED[part];
      colours[3 * k + part] = GREY[part] + Math.abs(level) * (far - GREY[part]);
    }
  }
  return colours;
}

/** Row of a ramp that shows a value. @param {number} value @param {number} full 0: nothing is there @param {boolean} isSigned */
export function row(value, full, isSigned) {
  const fraction = full > 0 ? value / full : 0;
  return Math.min(STEPS - 1, Math.max(0, Math.round((isSigned ? 0.5 + 0.5 * fraction : fraction) * (STEPS - 1)))) || 0;
}

/** The next number of two digits; 0 of 0. @param {number} value 0 or more */
export function roundUp(value) {
  if (!(value > 0)) return 0;
  const unit = 10 ** (Math.floor(Math.log10(value)) - 1);
  return Math.ceil((value / unit) * (1 - 1e-12)) * unit;
}

/** A number as people read it. @param {number} value @param {number} [digits] */
export function brief(value, digits = 4) {
  if (!Number.isFinite(value)) return "-";
  const size = Math.abs(value);
  const isFar = size !== 0 && (size < 1e-3 || size >= 1e5);
  const text = isFar ? value.toExponential(Math.max(digits - 3, 1)) : String(Number(value.toPrecision(digits)));
  return text.replace(".", fixed(0.1, 1)[1]);
}

/**
 * The scale beside a picture.
 * @param {HTMLCanvasElement} canvas
 * @param {{label: string, unit: string, isSigned: boolean} | null} channel null: the wire is plain
 * @param {number} full value of full red; 0: all that is shown is zero
 */
export function drawScale(canvas, channel, full) {
  canvas.hidden = !channel;
  if (!channel) return;
  const pen = prepare(canvas);
  const width = canvas.clientWidth;
  const scale = pen.createLinearGradient(0, 0, width, 0);
  (full === 0 ? [GREY, GREY] : channel.isSigned ? [BLUE, GREY, RED] : [GREY, RED]).forEach((colour, k, { length }) =>
    scale.addColorStop(k / (length - 1), `rgb(${colour.map((part) => Math.round(255 * part))})`));
  pen.fillStyle = scale;
  pen.fillRect(0, 0, width, 14);
  pen.fillStyle = ink("--ink");
  pen.fillText(channel.isSigned && full > 0 ? brief(-full) : "0", 0, 28);
  const end = full > 0 ? `${brief(full)} ${channel.unit}` : `0 ${channel.unit}`;
  pen.fillText(end, width - pen.measureText(end).width, 28);
  pen.fillText(channel.label, 0.5 * (width - pen.measureText(channel.label).width), 28);
}

/** A colour of the page, which depends on light and dark. @param {string} name of the property */
export function ink(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}

/** A pen for a canvas as large as it is shown. @param {HTMLCanvasElement} canvas */
export function prepare(canvas) {
  const ratio = globalThis.devicePixelRatio || 1;
  canvas.width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  canvas.height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  // Not on the graphics card, which has the picture to draw: the more where it is none.
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
  pen.scale(ratio, ratio);
  pen.font = "11px system-ui, sans-serif";
  return pen;
}
