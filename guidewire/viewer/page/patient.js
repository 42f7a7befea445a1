// @ts-check
/**
 * A generic patient around the vessel: skin, bones and lungs as closed surfaces, generated, of nobody. Positions are in mm to the
 * left, the back and the head, from the body's middle beside the eighth thoracic vertebra.
 * @typedef {[number, number, number]} Place
 * @typedef {{kind: "skin" | "bone" | "inner", attenuation: number, vertices: number[], triangles: number[]}} Part of 1/mm more than what
 *     it lies in; what is "inner" is seen by X-rays alone
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
  [0.016, 14, [[96, -10, -396], [124, -2, -416], [140, 4, -430]]], // neck of the femur
  [0.012, 17, [[140, 6, -414], [138, -2, -480], [126, -10, -640]]],
  [0.03, 9, [[64, 28, 368], [40, 12, 378], [16, -4, 384]]], // petrous bone
  [0.016, 8, [[56, 0, 372], [52, -12, 330], [40, -44, 318], [14, -84, 310], [0, -88, 308]]], // jaw
  [0.014, 6, [[66, -46, 402], [52, -72, 388], [30, -86, 372]]], // cheek
  [0.016, 4, Array.from({ length: 13 }, (_, k) => /** @type {Place} */ ([33 + 20 * Math.cos(k * Math.PI / 6),
    0.3 * Math.abs(20 * Math.cos(k * Math.PI / 6)) - 78, 404 + 18 * Math.sin(k * Math.PI / 6)]))], // orbit
];

/** The values at a height, linear between rows of a table that begins above. @param {number[][]} table @param {number} height */
function at(table, height) {
  const next = Math.max(1, table.findIndex(([row]) => row <= height));
  const [above, below] = [table[next - 1], table[next]];
  const part = Math.max(0, Math.min(1, (height - above[0]) / (below[0] - above[0])));
  return above.slice(1).map((value, k) => value + part * (below[k + 1] - value));
}

/** Joins rings of as many points, each counterclockwise about the way to the next one. Ends stay open. @param {Place[][]} rings */
function join(rings) {
  const sides = rings[0].length;
  const triangles = rings.slice(1).flatMap((_, row) => rings[0].flatMap((__, k) => {
    const [one, other] = [row * sides + k, row * sides + ((k + 1) % sides)];
    return [one, one + sides, other, other, one + sides, other + sides]; // facing inwards, as those of a vessel
  }));
  return { vertices: rings.flat(2), triangles };
}

/** @param {number[]} a @param {number[]} b */
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/** A curve through points, with so many pieces between two of them. @param {Place[]} line @param {number} pieces */
function curved(line, pieces) {
  return Array.from({ length: (line.length - 1) * pieces + 1 }, (_, i) => {
    const [k, t] = [Math.min(Math.floor(i / pieces), line.length - 2), i / pieces - Math.min(Math.floor(i / pieces), line.length - 2)];
    const [a, b, c, d] = [-1, 0, 1, 2].map((shift) => line[Math.max(0, Math.min(line.length - 1, k + shift))]);
    return /** @type {Place} */ (b.map((value, j) => value + 0.5 * t * (c[j] - a[j]
      + t * (2 * a[j] - 5 * value + 4 * c[j] - d[j] + t * (3 * (value - c[j]) + d[j] - a[j])))));
  });
}

/** A tube along a line, of half widths that may differ; its ends are round. @param {Place[]} line @param {number} wide
 * @param {number} [high] */
function tube(line, wide, high = wide, sides = 10) {
  let one = Math.abs(line[1][2] - line[0][2]) < 0.9 * Math.hypot(...line[1].map((value, k) => value - line[0][k])) ? [0, 0, 1] : [0, 1, 0];
  return join(line.map((place, i) => {
    const along = (line[i + 1] ?? place).map((value, k) => value - (line[i - 1] ?? place)[k]);
    one = cross(cross(along, one), along); // what was across before, without what goes along now
    const other = cross(along, one);
    const full = Math.sqrt(1.02 - ((2 * i) / (line.length - 1) - 1) ** 8);
    const [a, b] = [(full * wide) / Math.hypot(...one), (full * high) / Math.hypot(...other)];
    return Array.from({ length: sides }, (_, s) => /** @type {Place} */ (place.map((value, k) => value
      + a * Math.cos((2 * Math.PI * s) / sides) * one[k] + b * Math.sin((2 * Math.PI * s) / sides) * other[k])));
  }));
}

/** A rounded box, an ellipsoid where power is 1, turned in the picture from the front and about the way to the head.
 * @param {Place} centre @param {Place} radii @param {{power?: number, tilt?: number, turn?: number, rows?: number, sides?: number}} [shape] */
function blob(centre, radii, { power = 1, tilt = 0, turn = 0, rows = 12, sides = 18 } = {}) {
  const bent = (/** @type {number} */ value) => Math.sign(value) * Math.abs(value) ** power;
  return join(Array.from({ length: rows + 1 }, (_, row) => {
    const [high, wide] = [bent(-Math.cos((Math.PI * row) / rows)), bent(Math.sin((Math.PI * row) / rows))];
    return Array.from({ length: sides }, (__, s) => {
      const angle = (2 * Math.PI * s) / sides;
      const [x, y, z] = [wide * bent(Math.cos(angle)) * radii[0], wide * bent(Math.sin(angle)) * radii[1], high * radii[2]];
      const across = x * Math.cos(tilt) - z * Math.sin(tilt);
      return /** @type {Place} */ ([centre[0] + across * Math.cos(turn) - y * Math.sin(turn),
        centre[1] + across * Math.sin(turn) + y * Math.cos(turn), centre[2] + x * Math.sin(tilt) + z * Math.cos(tilt)]);
    });
  }));
}

/** All bones, and what X-rays see beside them. @returns {Part[]} */
function makeParts() {
  /** @type {Part[]} */
  const parts = [];
  const add = (/** @type {Part["kind"]} */ kind, /** @type {number} */ attenuation, /** @type {{vertices: number[], triangles: number[]}} */ mesh) =>
    parts.push({ kind, attenuation, ...mesh });
  for (const side of [1, -1]) {
    const on = (/** @type {Place[]} */ line) => line.map(([x, ...rest]) => /** @type {Place} */ ([side * x, ...rest]));
    for (const [attenuation, radius, line] of PAIRS) add("bone", attenuation, tube(curved(on(line), 6), radius));
    RIBS.forEach(([wide, deep, end], k) => {
      const [from, drop] = [196 - 25.5 * k, 53 + 8.4 * Math.min(k, 7)];
      const [back] = at(SPINE, from);
      const rib = Array.from({ length: 19 }, (_, i) => {
        const angle = (end * Math.PI * i) / 18;
        return /** @type {Place} */ ([side * (16 + wide * Math.sin(angle) * (1 + 0.1 * Math.sin(angle))),
          back + 8 - 0.94 * deep * (1 - Math.cos(angle)), from + 6 * Math.sin(2.4 * angle) * (1 - i / 18) - drop * (angle / Math.PI) ** 1.3]);
      });
      add("bone", 0.017, tube(rib, 3.9, 6));
      add("inner", -0.009, tube(rib, 2.4, 4)); // marrow
    });
    add("bone", 0.01, blob([side * 106, 64, 118], [34, 5, 66], { tilt: side * 0.25, turn: side * -0.5 })); // shoulder blade
    add("bone", 0.012, blob([side * 84, 22, -306], [52, 7, 62], { power: 0.85, tilt: side * -0.42, turn: side * -0.6 })); // ilium
    add("bone", 0.016, blob([side * 94, -10, -394], [25, 25, 25]));
    add("inner", -0.004, blob([side * 76, 6, 70], [58, 82, 138], { power: 0.86 })); // lung
  }
  for (let k = 0, height = 318; k < 24; k++) { // vertebrae, from the second of the neck on
    const [tall, gap, size] = k < 6 ? [17, 3, 0.62 + 0.02 * k] : k < 18 ? [20.9 + 0.35 * k, 4, 0.63 + 0.018 * k] : [32, 7, 0.63 + 0.018 * k];
    const [back] = at(SPINE, height);
    add("bone", 0.0105, blob([0, back, height], [23 * size, 18 * size, 0.41 * tall], { power: 0.5, rows: 8, sides: 20 }));
    add("bone", 0.012, tube(curved([[0, back + 22 * size, height - 4], [0, back + 50 * size, height - 0.5 * tall]], 4), 4.5, 8 * size));
    for (const side of [1, -1]) {
      add("bone", 0.02, blob([side * 15 * size, back + 20 * size, height + 0.12 * tall], [5 * size, 9 * size, 7 * size], { rows: 6, sides: 10 }));
      add("bone", 0.011, tube(curved([[side * 14 * size, back + 26 * size, height + 2],
        [side * (k < 18 ? 38 : 46) * size, back + 34 * size, height + 4]], 4), 4.5 * size));
    }
    height -= tall + gap;
  }
  add("bone", 0.006, blob([0, -112, 80], [19, 6, 86], { power: 0.8 })); // breastbone
  add("bone", 0.01, blob([0, 62, -352], [46, 17, 52], { power: 0.8 })); // sacrum
  add("bone", 0.017, blob([0, 0, 430], [75, 95, 94], { rows: 24, sides: 36 })); // skull
  add("inner", -0.0163, blob([0, 0, 430], [69, 89, 88], { rows: 24, sides: 36 }));
  add("bone", 0.012, blob([0, -66, 352], [30, 22, 18], { power: 0.7 })); // upper jaw
  add("inner", 0.004, blob([26, -22, 22], [62, 54, 76], { tilt: 0.6 })); // heart
  add("inner", 0.0018, blob([-58, -10, -88], [92, 78, 62])); // liver
  return parts;
}

/**
 * What of the patient lies around a vessel, in the scene.
 * @param {import("./carm.js").Patient} patient @param {[Place, Place]} box of the vessel, units @param {number} millimetres of a unit
 * @returns {Part[]}
 */
export function patientAround({ left, chest, head, origin }, [low, high], millimetres) {
  if (!origin) return [];
  const axes = [left, chest.map((value) => -value), head];
  const reach = axes.map((axis, k) => {
    const middle = origin[k] + 0.5 * millimetres * axis.reduce((sum, value, i) => sum + value * (low[i] + high[i]), 0);
    const half = NEAR + 0.5 * millimetres * axis.reduce((sum, value, i) => sum + Math.abs(value) * (high[i] - low[i]), 0);
    return [middle - half, middle + half];
  });
  const near = makeParts().filter(({ vertices }) => reach.every(([least, most], k) => {
    const own = vertices.filter((_, i) => i % 3 === k);
    return Math.min(...own) < most && Math.max(...own) > least;
  }));
  const [bottom, top] = [Math.max(-640, reach[2][0] - 2 * NEAR), Math.min(536, reach[2][1] + 2 * NEAR)];
  const rings = Array.from({ length: Math.ceil((top - bottom) / STEP) + 1 }, (_, row) => {
    const height = Math.min(top, bottom + row * STEP);
    const [wide, deep, back] = [0, 1, 2].map((k) => [-STEP, 0, STEP].reduce((sum, shift) => sum + at(OUTLINE, height + shift)[k] / 3, 0));
    return Array.from({ length: 40 }, (__, s) => /** @type {Place} */ (
      [wide * Math.cos((Math.PI * s) / 20), back + deep * Math.sin((Math.PI * s) / 20), height]));
  });
  return [...near, { kind: /** @type {"skin"} */ ("skin"), attenuation: 0.005, ...join(rings) }].map((part) => ({ ...part,
    vertices: part.vertices.map((_, i, all) => axes.reduce((sum, axis, j) => sum + axis[i % 3] * (all[i - (i % 3) + j] - origin[j]), 0) / millimetres) }));
}
