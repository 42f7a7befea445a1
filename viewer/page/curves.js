// @ts-check
import { brief as number, prepare } from "./colours.js";

const LINES = ["#e1e1e6", "#ff9d2e"]; // of the first run and the second
const LEFT = 46;
const BOTTOM = 16;

const brief = (/** @type {number} */ value) => number(value, 3); // as many digits as there is room for

/**
 * Draws curves with their axes.
 * @param {HTMLCanvasElement} canvas
 * @param {{x: ArrayLike<number>, y: ArrayLike<number>}[]} curves
 * @param {string} xLabel
 * @param {string} yLabel
 * @param {number} [cursor] x of a line through all
 */
export function drawCurves(canvas, curves, xLabel, yLabel, cursor) {
  const pen = prepare(canvas);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [left, right] = range(curves.map((curve) => curve.x));
  const [low, high] = range(curves.map((curve) => curve.y));
  const toX = (/** @type {number} */ x) => LEFT + ((x - left) / (right - left || 1)) * (width - LEFT - 4);
  const room = height - BOTTOM - 20;
  const toY = (/** @type {number} */ y) => height - BOTTOM - 4 - ((y - low) / (high - low || 1)) * room;
  pen.fillStyle = "#9aa";
  pen.strokeStyle = "#444b5a";
  pen.strokeRect(LEFT, 14, width - LEFT - 4, height - BOTTOM - 16);
  pen.fillText(yLabel, LEFT, 10);
  pen.fillText(brief(high), 0, 24);
  pen.fillText(brief(low), 0, height - BOTTOM - 2);
  pen.fillText(brief(left), LEFT, height - 4);
  const end = `${brief(right)}  ${xLabel}`;
  pen.fillText(end, width - 4 - pen.measureText(end).width, height - 4);
  if (low < 0 && high > 0) line(pen, LEFT, toY(0), width - 4, toY(0));
  curves.forEach(({ x, y }, k) => {
    pen.strokeStyle = LINES[k % LINES.length];
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
  if (cursor !== undefined) {
    pen.strokeStyle = "#c33";
    line(pen, toX(cursor), 14, toX(cursor), height - BOTTOM - 2);
  }
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
