// @ts-check
/** A scene for a mesh alone: its open ends are found, and a wire starts at the widest. `guidewire.py anatomy` finds much
 * more: closed ends, defects, the centreline. */

/** @typedef {number[]} Point @typedef {{path: string, bytes: Uint8Array}} OwnFile
 * @typedef {(what: string, part: number) => void} Tell */

const READING = "reading your mesh";
const ENDS = "looking for the open ends of your mesh";
const OFTEN = 0x3ffff; // lines, triangles or sides after which it is said how far one is

/** @param {Uint8Array} bytes of an .obj file @param {Tell} tell @returns {[Point[], number[][]]} vertices and faces */
function readObj(bytes, tell) {
  const text = new TextDecoder().decode(bytes);
  /** @type {Point[]} */
  const vertices = [];
  /** @type {number[][]} */
  const faces = [];
  for (let from = 0, line = 0; from < text.length; line++) {
    const end = text.indexOf("\n", from) + 1 || text.length + 1;
    const [word, ...rest] = text.slice(from, end - 1).trim().split(/\s+/);
    if (word === "v") vertices.push(rest.slice(0, 3).map(Number));
    else if (word === "f") {
      faces.push(rest.map((one) => {
        const index = parseInt(one, 10);
        return index < 0 ? vertices.length + index : index - 1;
      }));
    }
    from = end;
    if (!(line & OFTEN)) tell(READING, from / text.length);
  }
  return [vertices, faces];
}

/** @param {Uint8Array} bytes of an .stl file, in text or not @param {Tell} tell @returns {[Point[], number[][]]} */
function readStl(bytes, tell) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = bytes.length > 84 ? view.getUint32(80, true) : 0;
  /** @type {Map<string, number>} */
  const known = new Map();
  /** @type {Point[]} */
  const vertices = [];
  /** @type {number[][]} */
  const faces = [];
  const add = (/** @type {Point} */ corner, /** @type {number} */ part) => {
    const name = String(corner);
    if (!known.has(name)) known.set(name, vertices.push(corner) - 1);
    if (faces.at(-1)?.length !== 3 && faces.length) faces.at(-1)?.push(known.get(name) ?? 0);
    else faces.push([known.get(name) ?? 0]);
    if (faces.length % OFTEN === 1) tell(READING, part);
  };
  if (bytes.length === 84 + 50 * count) {
    for (let k = 0; k < 3 * count; k++) {
      add([0, 4, 8].map((at) => view.getFloat32(84 + 50 * Math.floor(k / 3) + 12 + 12 * (k % 3) + at, true)), k / (3 * count));
    }
  } else {
    const text = new TextDecoder().decode(bytes);
    for (const one of text.matchAll(/vertex\s+(\S+)\s+(\S+)\s+(\S+)/g)) add(one.slice(1).map(Number), one.index / text.length);
  }
  return [vertices, faces];
}

/** Closed lines of edges that one face alone has. @param {number[][]} faces @param {number} vertices their number
 * @param {Tell} tell */
function rimsOf(faces, vertices, tell) {
  /** @type {Map<number, [number, number]>} */
  const open = new Map();
  faces.forEach((face, index) => {
    face.forEach((a, k) => {
      const b = face[(k + 1) % face.length];
      const key = Math.min(a, b) * vertices + Math.max(a, b);
      if (!open.delete(key)) open.set(key, [a, b]);
    });
    if (!(index & OFTEN)) tell(ENDS, index / faces.length);
  });
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

/** The parameter file of those that were dropped: scene.json of a vessel's folder, or the only one. For a mesh alone one
 * is added. @param {OwnFile[]} files @param {Record<string, any>} wire @param {Tell} tell */
export function sceneAmong(files, wire, tell) {
  const all = files.map(({ path }) => path).filter((path) =>
    path.endsWith(".json") && !/(^|\/)(instruments\/.*|[^/]*anatomy\.json$)/.test(path));
  const scene = all.find((path) => /(^|\/)scene\.json$/.test(path)) ?? all[0];
  if (scene) return scene;
  const mesh = files.find(({ path }) => /\.(obj|stl)$/.test(path));
  if (!mesh) {
    throw new Error(`${files.map(({ path }) => path).join(", ")}: neither a parameter file (.json) nor a mesh (.obj, .stl)`);
  }
  const made = sceneOf(mesh.path, mesh.bytes, wire, tell);
  const add = (/** @type {string} */ path, /** @type {object} */ content) =>
    files.push({ path, bytes: new TextEncoder().encode(JSON.stringify(content)) });
  add(`${mesh.path}.ends.json`, made.ends);
  add(`${mesh.path}.json`, made.scene);
  return `${mesh.path}.json`;
}

/**
 * Parameters, and ends as `guidewire.py anatomy` writes them.
 * @param {string} path of the mesh @param {Uint8Array} bytes @param {Record<string, any>} wire parameters of a wire
 * @param {Tell} tell
 */
export function sceneOf(path, bytes, wire, tell = () => {}) {
  const [vertices, faces] = (path.endsWith(".obj") ? readObj : readStl)(bytes, tell);
  const middle = (/** @type {Point[]} */ points) => [0, 1, 2].map((axis) =>
    points.reduce((sum, point) => sum + point[axis], 0) / points.length);
  const ends = rimsOf(faces, vertices.length, tell).map((rim) => {
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
