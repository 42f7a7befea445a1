// @ts-check
/**
 * The centreline from the inlet to where the tip is to come, as `describe` of a session has it.
 * @typedef {object} Route
 * @property {string} name
 * @property {[number, number, number][]} points units
 * @property {number[]} radii
 * @property {number[]} distances from the inlet along the centreline, units
 */

/**
 * How far the tip is from its target along the vessel. A point belongs to the sphere of the centreline with the least
 * |p - c|^2 - r^2; in another branch its distance from the nearest sphere of the route is added.
 * @param {Route} route @param {ArrayLike<number>} tip units
 * @returns {{left: number, fraction: number, isReached: boolean}} units; part of the route that is done, from 0 to 1
 */
export function progress(route, tip) {
  let best = 0;
  let least = Infinity;
  route.points.forEach((point, k) => {
    const power = apart(point, tip) ** 2 - route.radii[k] ** 2;
    if (power < least) [best, least] = [k, power];
  });
  const last = route.points.length - 1;
  const whole = route.distances[last] || 1;
  const beyond = Math.max(0, apart(route.points[best], tip) - route.radii[best]);
  const left = whole - route.distances[best] + beyond;
  const isReached = beyond === 0 && whole - route.distances[best] <= route.radii[last];
  const fraction = isReached ? 1 : Math.max(0, Math.min(1, 1 - left / whole));
  return { left: isReached ? 0 : left, fraction, isReached };
}

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
function apart(a, b) {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
