// @ts-check
/**
 * What the page shows of a run that is stepped here, by the names, labels and units of guidewire/viewer/recording.py: a test
 * compares the two. Texts and tables come from there, as rules.
 *
 * @typedef {Record<string, Float64Array>} State arrays of the runner's answers by their names
 * @typedef {import("./recording.js").Channel} Channel
 * @typedef {object} Rules
 * @property {Record<string, string>} energies labels by key
 * @property {Record<string, [string, string, boolean]>} hub label, unit and sign by key
 */

/** Where the numbers read off at the hub of the wire stand, the first four also of a catheter. */
const HUB = /** @type {Record<string, number>} */ ({ insertion: 0, turn: 1, force: 2, torque: 3, twist: 10,
  largestCurvature: 11, lengthInBody: 12, inBody: 13 });
const CORE = [["coreStrain", "strain of the core"], ["coreShare", "share of the core beyond its elastic line"]];
const ENERGIES = ["kineticEnergy", "elasticEnergy", "potentialEnergy"];

/** Metres of a unit; null with gains, whose forces have no unit. @param {Record<string, any>} parameters */
function metresOf(parameters) {
  return "wireRadius" in parameters ? parameters.metresPerUnit : null;
}

/** @param {Float64Array} x @param {number} i @param {number} j @returns {number} */
function dot(x, i, j, y = x) {
  return x[i] * y[j] + x[i + 1] * y[j + 1] + x[i + 2] * y[j + 2];
}

/** Angle or turn between neighbouring elements over their mean length, 0 at the ends. @param {Float64Array} lengths
 * @param {(before: number) => number} between @param {number} perUnit */
function atJoints(lengths, between, perUnit) {
  return Float64Array.from({ length: lengths.length + 1 }, (_, i) => {
    if (i === 0 || i === lengths.length) return 0;
    const mean = 0.5 * (lengths[i - 1] + lengths[i]);
    return perUnit * (between(i - 1) / (mean > 0 ? mean : 1));
  });
}

/**
 * All channels of one frame.
 * @param {Rules} rules @param {Record<string, any>} parameters effective values @param {State} state
 * @param {boolean} hasWalls @param {number[]} measured wall time of a step, ms, and times faster than real time
 * @returns {Channel[]}
 */
export function makeChannels(rules, parameters, state, hasWalls, measured) {
  const metres = metresOf(parameters);
  const force = metres === null ? "mass unit·unit/s²" : "N";
  const bend = metres === null ? "rad/unit" : "rad/m";
  /** @type {Channel[]} */
  const channels = [];
  const add = (/** @type {string} */ name, /** @type {string} */ label, /** @type {string} */ unit,
    /** @type {Channel["place"]} */ place, /** @type {ArrayLike<number>} */ values, isSigned = false) =>
    channels.push({ name, label, unit, place, isSigned, width: values.length, largest: 0,
      values: Float64Array.from(values) });
  const x = state.positions;
  const along = new Float64Array(x.length - 3);
  const lengths = new Float64Array(along.length / 3);
  for (let k = 0; k < lengths.length; k++) {
    for (let part = 0; part < 3; part++) along[3 * k + part] = x[3 * k + 3 + part] - x[3 * k + part];
    lengths[k] = Math.sqrt(dot(along, 3 * k, 3 * k));
    for (let part = 0; part < 3; part++) along[3 * k + part] /= lengths[k] > 0 ? lengths[k] : 1;
  }
  const perUnit = metres === null ? 1 : 1 / metres;
  const joints = state.curvature;
  const rows = (/** @type {Float64Array} */ of) => [...Array(of.length / 3).keys()].map((i) => 3 * i);

  add("time", "", "s", "frame", state.time);
  add("step", "", "", "frame", state.step);
  add("positions", "", "units", "vector", x);
  const catheters = Object.keys(state).filter((name) => /^catheter\d+$/.test(name)).map((name) => name.slice(8));
  for (const k of catheters) add(`positions${k}`, "", "units", "vector", state[`positions${k}`]);
  add("curvature", "curvature", bend, "sphere", joints ? rows(joints).map((i) => Math.hypot(joints[i], joints[i + 1]))
    : atJoints(lengths, (k) => Math.acos(Math.min(1, Math.max(-1, dot(along, 3 * k, 3 * k + 3)))), perUnit));
  add("twist", "twist", bend, "sphere", joints ? rows(joints).map((i) => joints[i + 2])
    : atJoints(lengths, (k) => turnBetween(state.orientations, 4 * k, 4 * k + 4), perUnit), true);
  for (const [name, label] of CORE) {
    if (state[name]) add(name, label, "1", "sphere", state[name]);
  }
  if (state.force) {
    add("axialForce", "axial force", "N", "element", rows(along).map((i) => dot(state.force, i, i, along)), true);
  }
  if (hasWalls) {
    const forces = state.contactForces ?? new Float64Array(x.length);
    const ofCatheters = catheters.map((k) => state[`contactForces${k}`] ?? new Float64Array(0));
    const sizesOf = (/** @type {Float64Array} */ own) => rows(own).map((i) => Math.sqrt(dot(own, i, i)));
    add("contactForces", "", force, "vector", forces);
    add("contactForce", "contact force", force, "sphere", sizesOf(forces));
    catheters.forEach((k, i) => add(`contactForces${k}`, "", force, "vector", ofCatheters[i]));
    add("wallForce", "all wall forces added up", force, "frame",
      [[forces, ...ofCatheters].flatMap(sizesOf).reduce((sum, size) => sum + size, 0)]);
  }
  if (state.strandForces) {
    const own = state.strandForces;
    add("strandForce", "force between strands", force, "sphere", rows(own).map((i) => Math.sqrt(dot(own, i, i))));
  }
  for (const name of ["wallDisplacements", ...catheters.map((k) => `wallDisplacements${k}`)]) {
    if (state[name]) add(name, "", "units", "vector", state[name].map((value) => perUnit * value));
  }
  if (state.vesselPhase) add("vesselPhase", "phase of the vessel's cycle", "1", "frame", state.vesselPhase);
  if (state.vesselCentreline) add("vesselCentreline", "", "units", "vector", state.vesselCentreline);
  if (state.lumen) add("lumen", "", "", "frame", [state.lumen[5], state.lumen[1], state.lumen[0]]);
  const hub = (/** @type {string} */ key) => state.hub?.[HUB[key]] ?? NaN;
  const hubName = (/** @type {string} */ key) => key[0].toUpperCase() + key.slice(1);
  for (const [key, [label, unit, isSigned]] of Object.entries(rules.hub)) {
    if (!Number.isNaN(hub(key))) add(`hub${hubName(key)}`, label, unit, "frame", [hub(key)], isSigned);
  }
  for (const k of catheters) {
    for (const key of ["insertion", "turn", "force", "torque"]) {
      const [label, unit, isSigned] = rules.hub[key];
      add(`hub${k}${hubName(key)}`, `${label}, catheter ${k}`, unit, "frame", [state[`catheter${k}`][HUB[key]]],
        isSigned);
    }
  }
  if (!state.hub && state.reaction) {
    add("hubForce", "force at the hub", force, "frame", [dot(state.reaction, 0, 0, along)], true);
  }
  if (!state.hub && state.couple) {
    add("hubTorque", "torque at the hub", "N m", "frame", [dot(state.couple, 0, 0, along)], true);
  }
  if (state.energy) {
    const [kinetic, elastic, potential] = state.energy;
    add("energy", "energy", "J", "frame", [kinetic + elastic + potential]);
    ENERGIES.forEach((key, k) => add(key, rules.energies[key], "J", "frame", [state.energy[k]]));
  }
  if (!Number.isNaN(hub("inBody"))) add("inBody", "", "spheres", "frame", [hub("inBody")]);
  [..."xyz"].forEach((axis, k) =>
    add(`tip${axis}`, `tip, ${axis}`, "units", "frame", [x[x.length - 3 + k]], true));
  add("stepTime", "wall time of a step", "ms", "frame", [measured[0]]);
  add("realTime", "times faster than real time", "1", "frame", [measured[1]]);
  return channels;
}

/** Turn about the wire from one element to the next. @param {Float64Array} q @param {number} a @param {number} b */
function turnBetween(q, a, b) {
  const w = dot(q, a, b) + q[a + 3] * q[b + 3];
  const z = q[a + 3] * q[b + 2] - q[a + 2] * q[b + 3] - (q[a] * q[b + 1] - q[a + 1] * q[b]);
  return 2 * Math.atan2(w < 0 ? -z : z, Math.abs(w));
}

/** Largest size of each channel's finite numbers, what is in a sheath left out. @param {Channel[]} channels */
export function largestShown(channels) {
  const inBody = channels.find(({ name }) => name === "inBody")?.values[0];
  return channels.map(({ place, values, width }) => {
    const perNode = place === "vector" ? 3 : 1;
    const nodes = width / perNode + (place === "element" ? 1 : 0);
    const first = inBody === undefined || place === "frame" ? 0 : perNode * Math.max(nodes - 1 - inBody, 0);
    return values.subarray(first).reduce((most, value) =>
      (Number.isFinite(value) ? Math.max(most, Math.abs(value)) : most), 0);
  });
}

/** The wire's radius in units. @param {Record<string, any>} parameters */
export function radiusOf(parameters) {
  return "wireRadius" in parameters ? parameters.wireRadius / parameters.metresPerUnit : parameters.sphereRadius;
}

/** What is shown beside the picture. @param {Record<string, any>} parameters @returns {[string, string][]} */
export function factsOf(parameters) {
  return [["method", parameters.solver], ["elements", String(parameters.numberRodElements)],
    ["time step", `${parameters.timeStep} s`]];
}

/** Where a sheath ends, and where the wire begins in it, of a wire at its start. @param {Record<string, any>} parameters
 * @param {State} state @returns {[number[], number[]] | null} */
export function sheathOf(parameters, { positions, hub }) {
  if (!parameters.sheath) return null;
  const [start, next, tip] = [[0, 3], [3, 6], [-3, undefined]].map(([from, to]) => [...positions.slice(from, to)]);
  const along = next.map((value, k) => value - start[k]);
  const direction = along.map((value) => value / Math.hypot(...along));
  const exit = parameters.sheath.exit ?? tip.map((value, k) =>
    value - direction[k] * (hub[HUB.lengthInBody] / parameters.metresPerUnit));
  const back = Math.min(0, start.reduce((sum, value, k) => sum + (value - exit[k]) * direction[k], 0));
  return [exit, direction.map((value, k) => exit[k] + back * value)];
}
