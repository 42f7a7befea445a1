// @ts-check
import { brief, ink, prepare } from "./colours.js";

const SECOND = "#e08214"; // of the second run
const BOTTOM = 16;
const ALIGNED = 44; // points beside curves that stand over one another
const GAP = 4; // points between an axis and what stands beside it
const MOST_DIGITS = 12;

/**
 * Draws curves with their axes.
 * @param {HTMLCanvasElement} canvas
 * @param {{x: ArrayLike<number>, y: ArrayLike<number>, colour?: string, dash?: number[], band?: ArrayLike<number>, isSudden?: boolean}[]}
 *     curves colour: of the page's tokens; band: lowest and highest value at each x; isSudden: a cross marks a largest value in the
 *     first step, where a start is sudden
 * @param {string} xLabel
 * @param {string} yLabel
 * @param {number} [cursor] x of a line through all @param {[number, number][]} [shades] from which x to which it is shaded, of
 *     curves over one another
 * @returns {(point: number) => number} x of a point of the canvas
 */
export function drawCurves(canvas, curves, xLabel, yLabel, cursor, shades) {
  const pen = prepare(canvas);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [left, right] = range(curves.map((curve) => curve.x));
  const [low, high] = range(curves.flatMap(({ y, band }) => (band ? [y, band] : [y])));
  const [lowText, highText] = endLabels(low, high);
  const [leftText, rightText] = endLabels(left, right);
  const margin = GAP + Math.max(shades ? ALIGNED : 0, pen.measureText(lowText).width, pen.measureText(highText).width);
  const toX = (/** @type {number} */ x) => margin + ((x - left) / (right - left || 1)) * (width - margin - GAP);
  const clearance = height - BOTTOM - 20;
  const toY = (/** @type {number} */ y) => height - BOTTOM - 4 - ((y - low) / (high - low || 1)) * clearance;
  pen.fillStyle = ink("--quiet");
  pen.strokeStyle = ink("--edge");
  pen.strokeRect(margin, 14, width - margin - GAP, height - BOTTOM - 16);
  pen.fillText(yLabel, Math.max(0, Math.min(margin, width - GAP - pen.measureText(yLabel).width)), 10);
  if (highText !== lowText) pen.fillText(highText, 0, 24);
  pen.fillText(lowText, 0, height - BOTTOM - 2);
  pen.fillText(leftText, margin, height - 4);
  const end = rightText === leftText ? xLabel : `${rightText}  ${xLabel}`;
  pen.fillText(end, width - GAP - pen.measureText(end).width, height - 4);
  if (low < 0 && high > 0) line(pen, margin, toY(0), width - GAP, toY(0));
  for (const [from, to] of shades ?? []) {
    pen.fillStyle = `${ink("--caution")}38`;
    pen.fillRect(toX(from), 14, toX(to) - toX(from), height - BOTTOM - 16);
  }
  curves.forEach(({ x, y, colour, dash, band, isSudden }, k) => {
    pen.fillStyle = pen.strokeStyle = colour ? ink(colour) : k === 0 ? ink("--ink") : SECOND;
    pen.globalAlpha = 0.25;
    for (let i = 1; band && i < x.length; i++) {
      pen.beginPath();
      for (const [at, side] of [[i - 1, 0], [i - 1, 1], [i, 1], [i, 0]]) pen.lineTo(toX(x[at]), toY(band[2 * at + side]));
      pen.fill();
    }
    pen.globalAlpha = 1;
    const largest = Array.from(y).reduce((best, value, i) => (Math.abs(value) > Math.abs(y[best]) ? i : best), 0);
    if (isSudden && largest < 2 && y.length > 2) pen.fillText("×", toX(x[largest]) - 3, toY(y[largest]) + 4);
    pen.setLineDash(dash ?? []);
    pen.beginPath();
    const stride = Math.max(1, Math.floor(x.length / 2000)); // more points than that are not seen
    for (let i = 0, isDown = false; i < x.length; i += stride) {
      if (!Number.isFinite(y[i])) {
        isDown = false;
      } else if (isDown) {
        pen.lineTo(toX(x[i]), toY(y[i]));
      } else {
        pen.moveTo(toX(x[i]), toY(y[i]));
        isDown = true;
      }
    }
    pen.stroke();
  });
  if (cursor !== undefined && cursor >= left && cursor <= right) {
    pen.strokeStyle = "#c33";
    pen.setLineDash([]);
    line(pen, toX(cursor), 14, toX(cursor), height - BOTTOM - 2);
  }
  return (point) => left + ((point - margin) / (width - margin - GAP)) * (right - left);
}

/**
 * What stands at both ends of an axis: with as many digits as it takes to tell them apart, the same only where they are.
 * @param {number} low @param {number} high @returns {[string, string]}
 */
export function endLabels(low, high) {
  for (let digits = 3; digits <= MOST_DIGITS; digits++) {
    const [first, last] = [brief(low, digits), brief(high, digits)];
    if (first !== last) return [first, last];
  }
  return [brief(low, 3), brief(low, 3)];
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} toX @param {number} toY */
function line(pen, x, y, toX, toY) {
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(toX, toY);
  pen.stroke();
}

/** Lowest and highest of numbers that are finite. @param {ArrayLike<number>[]} all @returns {[number, number]} */
function range(all) {
  let [low, high] = [Infinity, -Infinity];
  for (const numbers of all) {
    for (let k = 0; k < numbers.length; k++) {
      if (numbers[k] < low) low = numbers[k];
      if (numbers[k] > high) high = numbers[k];
    }
  }
  return low <= high ? [low, high] : [0, 1];
}
