// @ts-check
/** A scene for a mesh alone: its open ends are found, and a wire starts at the widest. `guidewire.py anatomy` finds much
 * more: closed ends, defects, the centreline. */

/** @typedef {number[]} Point */

/** @param {string} text of an .obj file @returns {[Point[], number[][]]} vertices and faces */
function readObj(text) {
  const rows = text.split("\n").map((line) => line.trim().split(/\s+/));
  const vertices = rows.filter(([word]) => word === "v").map((row) => row.slice(1, 4).map(Number));
  return [vertices, rows.filter(([word]) => word === "f").map((row) => row.slice(1).map((one) => {
    const index = parseInt(one, 10);
    return index < 0 ? vertices.length + index : index - 1;
  }))];
}

/** @param {Uint8Array} bytes of an .stl file, in text or not @returns {[Point[], number[][]]} */
function readStl(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = bytes.length > 84 ? view.getUint32(80, true) : 0;
  const corners = bytes.length === 84 + 50 * count
    ? Array.from({ length: 3 * count }, (_, k) => [0, 4, 8].map((at) =>
      view.getFloat32(84 + 50 * Math.floor(k / 3) + 12 + 12 * (k % 3) + at, true)))
    : [...new TextDecoder().decode(bytes).matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/g)].map((one) =>
      one.slice(1).map(Number));
  /** @type {Map<string, number>} */
  const known = new Map();
  const indices = corners.map((corner) => known.get(String(corner)) ?? known.set(String(corner), known.size).size - 1);
  const vertices = [...known.keys()].map((text) => text.split(",").map(Number));
  return [vertices, Array.from({ length: corners.length / 3 }, (_, t) => indices.slice(3 * t, 3 * t + 3))];
}

/** Closed lines of edges that one face alone has. @param {number[][]} faces */
function rimsOf(faces) {
  /** @type {Map<string, [number, number]>} */
  const open = new Map();
  for (const face of faces) {
    face.forEach((a, k) => {
      const b = face[(k + 1) % face.length];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      if (!open.delete(key)) open.set(key, [a, b]);
    });
  }
  const next = new Map(open.values());
  const rims = [];
  for (const [first] of next) {
    const rim = [];
    for (let at = first; next.has(at);) {
      rim.push(at);
      const following = next.get(at);
      next.delete(at);
      at = following ?? -1;
    }
    if (rim.length > 2) rims.push(rim);
  }
  return rims;
}

/**
 * Parameters, and ends as `guidewire.py anatomy` writes them.
 * @param {string} path of the mesh @param {Uint8Array} bytes @param {Record<string, any>} wire parameters of a wire
 */
export function sceneOf(path, bytes, wire) {
  const [vertices, faces] = path.endsWith(".obj") ? readObj(new TextDecoder().decode(bytes)) : readStl(bytes);
  const middle = (/** @type {Point[]} */ points) => [0, 1, 2].map((axis) =>
    points.reduce((sum, point) => sum + point[axis], 0) / points.length);
  const ends = rimsOf(faces).map((rim) => {
    const points = rim.map((index) => vertices[index]);
    const centre = middle(points);
    const distance = (/** @type {Point} */ point) => Math.hypot(...point.map((value, axis) => value - centre[axis]));
    const radius = points.reduce((sum, point) => sum + distance(point), 0) / points.length;
    const near = middle(vertices.filter((point) => distance(point) < 2.5 * radius));
    const length = distance(near) || 1;
    return { centre, radius, direction: near.map((value, axis) => (value - centre[axis]) / length) };
  }).sort((one, other) => other.radius - one.radius);
  if (!ends.length) throw new Error(`${path}: has no open end: 'guidewire.py anatomy ${path} --open' cuts its ends open`);
  const name = path.replace(/^.*\//, "");
  const [{ centre, radius, direction }] = ends;
  const ahead = centre.map((value, axis) => value + radius * direction[axis]);
  return {
    scene: { ...wire, vessel: { shape: "mesh", file: name, anatomy: `${name}.ends.json` }, sheath: {}, inlet: 1 },
    ends: { ends: ends.map((end, k) => ({ ...end, number: k + 1, name: `end ${k + 1}`, open: true, point: Math.min(k, 1) })),
      centreline: { points: [[...centre, radius], [...ahead, radius]], parents: [-1, 0], branches: [1, 1],
        names: ["branch 1"] } },
  };
}
