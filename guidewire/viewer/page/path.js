// @ts-check
const STRETCH = 1e-3; // of an element's length, by which it may be longer

/**
 * A wire's spheres and one point more for each catheter: its tip where the wire comes out of it, as
 * guidewire/logs/paths.py has it, else the middle of the last element.
 * @param {Float64Array} x x, y, z of each sphere @param {Float64Array[]} catheters the same of each catheter
 * @param {Float64Array} lengths of the wire's elements, units
 * @returns {{ points: Float64Array, along: number[] }} and where each point is along the wire, in elements
 */
export function throughTips(x, catheters, lengths) {
  if (!catheters.length) return { points: x, along: Array.from({ length: x.length / 3 }, (_, i) => i) };
  const points = Array.from({ length: x.length / 3 }, (_, i) => [...x.subarray(3 * i, 3 * i + 3)]);
  const along = points.map((_, i) => i);
  for (const catheter of catheters) {
    const tip = [...catheter.slice(-3)];
    const away = points.map((point) => Math.hypot(...point.map((part, k) => part - tip[k])));
    let [crossing, least] = [-1, Infinity];
    for (let j = 0; j + 1 < points.length; j++) {
      const byTip = away[j] + away[j + 1];
      const excess = byTip - Math.hypot(...points[j].map((part, k) => points[j + 1][k] - part));
      if (!(byTip <= (1 + STRETCH) * lengths[Math.floor(along[j])] && excess < least)) continue;
      least = excess;
      crossing = Math.min(away[j], away[j + 1]) > 0 ? j : -1;
    }
    const j = crossing < 0 ? points.length - 2 : crossing;
    const fraction = crossing < 0 ? 0.5 : away[j] / (away[j] + away[j + 1]);
    const middle = points[j].map((part, k) => 0.5 * (part + points[j + 1][k]));
    along.splice(j + 1, 0, along[j] + fraction * (along[j + 1] - along[j]));
    points.splice(j + 1, 0, crossing < 0 ? middle : tip);
  }
  return { points: new Float64Array(points.flat()), along };
}
