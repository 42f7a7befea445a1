// @ts-check
/**
 * A generic patient around the vessel: skin, bones and lungs as closed surfaces, generated, of nobody. Places are in mm to the
 * left, the back and the head, from the body's middle beside the eighth thoracic vertebra.
 * @typedef {[number, number, number]} Place
 * @typedef {{vertices: number[], triangles: number[]}} Surface
 * @typedef {Surface & {kind: "skin" | "bone" | "inner", attenuation: number}} Part of 1/mm more than what it lies in; what is "inner"
 *     is seen by X-rays alone
 */

const NEAR = 50; // mm from the vessel's box: what is farther away is left out
const STEP = 12; // mm of the skin between two of its rings
/** The skin's outline: height, half width, half depth, and how far back its middle is. */
const OUTLINE = [[536, 6, 6, 0], [528, 42, 50, -2], [500, 66, 82, -2], [440, 77, 96, -4], [380, 70, 90, -8], [330, 58, 74, -12],
  [290, 57, 58, 8], [250, 66, 60, 12], [222, 120, 66, 12], [196, 178, 82, 6], [140, 184, 104, -2], [40, 172, 116, -6], [-80, 158, 112, -8],
  [-190, 148, 104, -6], [-300, 168, 108, 0], [-400, 180, 112, 4], [-520, 174, 104, 0], [-640, 160, 92, 0]];
/** The spine: height, and how far back the vertebrae's middles are. */
const SPINE = [[330, -8], [270, 16], [210, 34], [60, 66], [-60, 58], [-200, 30], [-300, 34], [-400, 66]];
/** Ribs from above: half width, depth, and where each ends, in half circles from the spine. */
const RIBS = [[52, 46, 0.86], [84, 70, 0.84], [102, 86, 0.82], [114, 96, 0.82], [122, 102, 0.8], [128, 106, 0.8], [132, 106, 0.78],
  [134, 104, 0.74], [133, 100, 0.7], [128, 94, 0.66], [112, 80, 0.52], [84, 60, 0.38]];
/** Bones of which there are two, as tubes on the left: attenuation, radius, and the line. @type {[number, number, Place[]][]} */
const PAIRS = [
  [0.016, 6, [[22, -58, 186], [62, -62, 200], [104, -40, 214], [140, -20, 212], [168, -4, 206]]], // clavicle
  [0.014, 9, [[42, 56, -330], [64, 30, -356], [78, -8, -384], [62, -34, -410], [34, -54, -424], [6, -58, -432]]], // pelvic brim
  [0.013, 9, [[82, -4, -396], [72, 14, -440], [52, 6, -468], [30, -26, -452], [10, -54, -436]]], // ischium and pubis
  [0.016, 14, [[96, -10, -396], [124, -2, -416], [140, 4, -430]]], [0.012, 17, [[140, 6, -414], [138, -2, -480], [126, -10, -640]]], // femur
  [0.03, 9, [[64, 28, 368], [40, 12, 378], [16, -4, 384]]], // petrous bone
  [0.016, 8, [[56, 0, 372], [52, -12, 330], [40, -44, 318], [14, -84, 310], [0, -88, 308]]], // jaw
  [0.014, 6, [[66, -46, 402], [52, -72, 388], [30, -86, 372]]], // cheek
  [0.016, 4, [[53, -72, 404], [47, -74, 417], [33, -78, 422], [19, -74, 417], [13, -72, 404], [19, -74, 391], [33, -78, 386], [47, -74, 391],
    [53, -72, 404]]], // orbit
];

/** The values at a height, linear between rows of a table that begins above. @param {number[][]} table @param {number} height */
function at(table, height) {
  const next = Math.max(1, table.findIndex(([row]) => row <= height));
  const [above, below] = [table[next - 1], table[next]];
  const part = Math.max(0, Math.min(1, (height - above[0]) / (below[0] - above[0])));
  return above.slice(1).map((value, k) => value + part * (below[k + 1] - value));
}

/** Joins rings, each counterclockwise about the way to the next one, by triangles that face inwards as those of a vessel do.
 * Ends stay open. @param {number} count of rings @param {number} sides @param {(ring: number, angle: number) => number[]} place */
function join(count, sides, place) {
  const all = Array.from({ length: count * sides }, (_, k) => k);
  return { vertices: all.flatMap((k) => place(Math.floor(k / sides), (2 * Math.PI * (k % sides)) / sides)),
    triangles: all.slice(sides).flatMap((k) => {
      const [one, other] = [k - sides, k % sides === sides - 1 ? k - 2 * sides + 1 : k - sides + 1];
      return [one, k, other, other, k, other + sides];
    }) };
}

/** @param {number[]} a @param {number[]} b */
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** A tube with round ends along a curve through points. @param {Place[]} points @param {number} wide half of it
 * @param {number} [high] half of the other width @param {number} [pieces] of the curve between two points */
function tube(points, wide, high = wide, pieces = 5) {
  const last = (points.length - 1) * pieces;
  const line = Array.from({ length: last + 1 }, (_, i) => {
    const k = Math.min(Math.floor(i / pieces), points.length - 2);
    const t = i / pieces - k;
    const [a, b, c, d] = [k - 1, k, k + 1, k + 2].map((n) => points[Math.max(0, Math.min(points.length - 1, n))]);
    return b.map((value, j) => value + 0.5 * t * (c[j] - a[j]
      + t * (2 * a[j] - 5 * value + 4 * c[j] - d[j] + t * (3 * (value - c[j]) + d[j] - a[j]))));
  });
  let one = Math.abs(line[1][2] - line[0][2]) < 0.9 * Math.hypot(...line[1].map((value, k) => value - line[0][k])) ? [0, 0, 1] : [0, 1, 0];
  const frames = line.map((place, i) => {
    const along = (line[i + 1] ?? place).map((value, k) => value - (line[i - 1] ?? place)[k]);
    one = cross(cross(along, one), along); // what was across before, without what goes along now
    const [other, full] = [cross(along, one), Math.sqrt(1.02 - ((2 * i) / last - 1) ** 8)];
    return [one.map((value) => (value * full * wide) / Math.hypot(...one)), other.map((value) => (value * full * high) / Math.hypot(...other))];
  });
  return join(last + 1, 10, (i, angle) => line[i].map((value, k) => value + Math.cos(angle) * frames[i][0][k] + Math.sin(angle) * frames[i][1][k]));
}

/** An ellipsoid, or a rounded box where power is below 1. @param {Place} centre @param {Place} radii @param {number} [power]
 * @param {number} [tilt] in the picture from the front @param {number} [turn] about the way to the head */
function blob(centre, radii, power = 1, tilt = 0, turn = 0) {
  const bent = (/** @type {number} */ value) => Math.sign(value) * Math.abs(value) ** power;
  const rows = Math.min(24, Math.round(5 + Math.max(...radii) / 6));
  return join(rows + 1, 2 * rows, (row, angle) => {
    const wide = bent(Math.sin((Math.PI * row) / rows));
    const [x, y, z] = [wide * bent(Math.cos(angle)), wide * bent(Math.sin(angle)), -bent(Math.cos((Math.PI * row) / rows))].map((value, k) => value * radii[k]);
    const across = x * Math.cos(tilt) - z * Math.sin(tilt);
    return [centre[0] + across * Math.cos(turn) - y * Math.sin(turn), centre[1] + across * Math.sin(turn) + y * Math.cos(turn),
      centre[2] + x * Math.sin(tilt) + z * Math.cos(tilt)];
  });
}

/** All of the patient but the skin. */
function makeParts() {
  /** @type {Part[]} */
  const parts = [];
  const bone = (/** @type {number} */ attenuation, /** @type {Surface} */ surface) => parts.push({ kind: "bone", attenuation, ...surface });
  const inner = (/** @type {number} */ attenuation, /** @type {Surface} */ surface) => parts.push({ kind: "inner", attenuation, ...surface });
  for (const side of [1, -1]) {
    for (const [attenuation, radius, line] of PAIRS) bone(attenuation, tube(line.map(([x, y, z]) => [side * x, y, z]), radius));
    RIBS.forEach(([wide, deep, end], k) => {
      const [from, drop] = [196 - 25.5 * k, 53 + 8.4 * Math.min(k, 7)];
      const rib = Array.from({ length: 19 }, (_, i) => {
        const angle = (end * Math.PI * i) / 18;
        return /** @type {Place} */ ([side * (16 + wide * Math.sin(angle) * (1 + 0.1 * Math.sin(angle))), at(SPINE, from)[0] + 8
          - 0.94 * deep * (1 - Math.cos(angle)), from + 6 * Math.sin(2.4 * angle) * (1 - i / 18) - drop * (angle / Math.PI) ** 1.3]);
      });
      bone(0.017, tube(rib, 3.9, 6, 1));
      inner(-0.009, tube(rib, 2.4, 4, 1)); // marrow
    });
    bone(0.01, blob([side * 106, 64, 118], [34, 5, 66], 1, side * 0.25, side * -0.5)); // shoulder blade
    bone(0.012, blob([side * 84, 22, -306], [52, 7, 62], 0.85, side * -0.42, side * -0.6)); // ilium
    bone(0.016, blob([side * 94, -10, -394], [25, 25, 25])); // head of the femur
    inner(-0.004, blob([side * 76, 6, 70], [58, 82, 138], 0.86)); // lung
  }
  for (let k = 0, height = 318; k < 24; k++) { // vertebrae, from the second of the neck on
    const [tall, gap, size] = k < 6 ? [17, 3, 0.62 + 0.02 * k] : k < 18 ? [20.9 + 0.35 * k, 4, 0.63 + 0.018 * k] : [32, 7, 0.63 + 0.018 * k];
    const [back] = at(SPINE, height);
    bone(0.0105, blob([0, back, height], [23 * size, 18 * size, 0.41 * tall], 0.5));
    bone(0.012, tube([[0, back + 22 * size, height - 4], [0, back + 50 * size, height - 0.5 * tall]], 4.5, 8 * size));
    for (const side of [1, -1]) {
      bone(0.02, blob([side * 15 * size, back + 20 * size, height + 0.12 * tall], [5 * size, 9 * size, 7 * size]));
      bone(0.011, tube([[side * 14 * size, back + 26 * size, height + 2], [side * (k < 18 ? 38 : 46) * size, back + 34 * size, height + 4]], 4.5 * size));
    }
    height -= tall + gap;
  }
  bone(0.006, blob([0, -112, 80], [19, 6, 86], 0.8)); // breastbone
  bone(0.01, blob([0, 62, -352], [46, 17, 52], 0.8)); // sacrum
  bone(0.017, blob([0, 0, 430], [75, 95, 94])); // skull
  inner(-0.0163, blob([0, 0, 430], [69, 89, 88]));
  bone(0.012, blob([0, -66, 352], [30, 22, 18], 0.7)); // upper jaw
  inner(0.004, blob([26, -22, 22], [62, 54, 76], 1, 0.6)); // heart
  inner(0.0018, blob([-58, -10, -88], [92, 78, 62])); // liver
  return parts;
}

/** What was made last: a run that begins anew has the same. */
let made = { of: "", parts: /** @type {Part[]} */ ([]) };

/**
 * What of the patient lies around a vessel, in the scene; the skin is the last.
 * @param {import("./carm.js").Patient} patient @param {[Place, Place]} box of the vessel, units @param {number} millimetres of a unit
 * @returns {Part[]}
 */
export function patientAround({ left, chest, head, origin }, [low, high], millimetres) {
  if (!origin) return [];
  const of = JSON.stringify([left, chest, head, origin, low, high, millimetres]);
  if (of === made.of) return made.parts;
  const axes = [left, chest.map((value) => -value), head];
  const reach = axes.map((axis, k) => [1, -1].map((side) => axis.reduce((sum, value, i) => sum + 0.5 * millimetres
    * (value * (low[i] + high[i]) - side * Math.abs(value) * (high[i] - low[i])), origin[k] - side * NEAR)));
  const near = makeParts().filter(({ vertices }) => reach.every(([least, most], k) => [-1, 1].every((side) =>
    vertices.some((value, i) => i % 3 === k && (side < 0 ? value < most : value > least)))));
  const [bottom, top] = [Math.max(-640, reach[2][0] - 2 * NEAR), Math.min(536, reach[2][1] + 2 * NEAR)];
  const skin = join(Math.ceil((top - bottom) / STEP) + 1, 40, (row, angle) => {
    const height = Math.min(top, bottom + row * STEP);
    const [wide, deep, back] = [0, 1, 2].map((k) => [-STEP, 0, STEP].reduce((sum, shift) => sum + at(OUTLINE, height + shift)[k] / 3, 0));
    return [wide * Math.cos(angle), back + deep * Math.sin(angle), height];
  });
  made = { of, parts: [...near, /** @type {Part} */ ({ kind: "skin", attenuation: 0.005, ...skin })].map((part) => ({ ...part,
    vertices: part.vertices.map((_, i, all) => axes.reduce((sum, axis, j) => sum + axis[i % 3] * (all[i - (i % 3) + j] - origin[j]), 0) / millimetres) })) };
  return made.parts;
}
