// @ts-check
/**
 * The centreline from the inlet to where the tip is to come, as `describe` of a session has it.
 * @typedef {object} Route
 * @property {string} name
 * @property {number} reach units before the target from which on it is reached
 * @property {[number, number, number][]} points units
 * @property {number[]} radii
 * @property {number[]} distances from the inlet along the centreline, units
 */

/**
 * How far the wire is from its target along the vessel, as the run itself counts it: outside of the lumen nothing is
 * gained.
 * @param {Route} route @param {ArrayLike<number>} lumen of a frame: units to the target, and whether it is reached
 * @returns {{left: number, fraction: number, isReached: boolean}} units; part of the route that is done, from 0 to 1
 */
export function progress(route, lumen) {
  const whole = route.distances[route.distances.length - 1] || 1;
  const isReached = lumen[1] > 0;
  const left = isReached ? 0 : lumen[0];
  return { left, fraction: Math.max(0, Math.min(1, 1 - left / whole)), isReached };
}
