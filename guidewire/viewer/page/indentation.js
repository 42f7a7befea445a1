// @ts-check
const REACH = 4; // beyond the wire's surface, of its radius

/**
 * Moves vertices of a wall that gives way to where it is drawn, as WallIndentation of the core: those near a contact go
 * with it, the less the farther away they are.
 * @param {Float32Array} rest units @param {Float32Array} moved at rest, or moved by another instrument
 * @param {Float64Array} x nodes of an instrument, units @param {Float64Array} displacements at its elements, units
 * @param {number} radius of it, units
 * @returns {boolean} whether any vertex goes with it
 */
export function press(rest, moved, x, displacements, radius) {
  let isMoved = false;
  for (let j = 0; j < displacements.length; j += 3) {
    const [dx, dy, dz] = displacements.subarray(j, j + 3);
    const size = Math.hypot(dx, dy, dz);
    if (!(size > 0)) continue; // most elements touch nothing
    const chord = [x[j + 3] - x[j], x[j + 4] - x[j + 1], x[j + 5] - x[j + 2]];
    const squared = chord[0] ** 2 + chord[1] ** 2 + chord[2] ** 2;
    const reach = ((1 + REACH) * radius + Math.sqrt(squared)) ** 2;
    for (let i = 0; i < rest.length; i += 3) {
      const [a, b, c] = [rest[i] - x[j], rest[i + 1] - x[j + 1], rest[i + 2] - x[j + 2]];
      if (a * a + b * b + c * c >= reach) continue;
      const s = Math.min(1, Math.max(0, (a * chord[0] + b * chord[1] + c * chord[2]) / squared));
      const [u, v, w] = [a - s * chord[0], b - s * chord[1], c - s * chord[2]];
      const distance = Math.hypot(u, v, w);
      const beyond = Math.max(0, distance - radius) / (REACH * radius);
      const side = distance > 0 ? (u * dx + v * dy + w * dz) / (distance * size) : 0;
      const share = beyond < 1 && side > 0 ? (1 - beyond * beyond) ** 2 * side : 0;
      const before = Math.hypot(moved[i] - rest[i], moved[i + 1] - rest[i + 1], moved[i + 2] - rest[i + 2]);
      if (share * size <= before) continue;
      moved[i] = rest[i] + share * dx;
      moved[i + 1] = rest[i + 1] + share * dy;
      moved[i + 2] = rest[i + 2] + share * dz;
      isMoved = true;
    }
  }
  return isMoved;
}
