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
 * @param {number} first units to the target as the run began
 * @param {ArrayLike<number>} lumen of a frame: units to the target, and whether it is reached
 * @returns {{left: number, fraction: number, isReached: boolean}} units; part of the way that is done, from 0 to 1
 */
export function progress(first, lumen) {
  const isReached = lumen[1] > 0;
  const left = isReached ? 0 : lumen[0];
  return { left, fraction: isReached ? 1 : Math.max(0, Math.min(1, 1 - left / (first || 1))), isReached };
}

/** A place of a vessel as one calls it: ends without a name are outlets, a point is the target. @param {string} name */
export function placeName(name) {
  return name.startsWith("[") ? "the target" : name.replace(/^rim (\d+)$/i, "outlet $1");
}
