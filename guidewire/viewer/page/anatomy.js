// @ts-check
/**
 * A vessel as `guidewire/viewer/anatomy.py` writes it, in mm: wall, ends, defects. A click on an end makes it the inlet.
 *
 * @typedef {object} End
 * @property {number} number
 * @property {string} name
 * @property {boolean} isOpen
 * @property {number} radius
 * @property {[number, number, number]} centre
 * @property {[number, number, number]} direction into the lumen
 */
import {
  AmbientLight, BufferAttribute, BufferGeometry, CircleGeometry, Color, DirectionalLight, DoubleSide, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, PerspectiveCamera, Points, PointsMaterial, Raycaster, Scene, Vector2, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { byId, make } from "./panel.js";

const END = 0x4aa8ff;
const CLOSED = 0x8fa9c4;
const INLET = 0x35d07f;
const PLACES = ["#e5484d", "#ff4fd8", "#ff9d2e", "#e0b02c", "#b58cff"];
const LEAST_END = 0.008; // radius of an end as it is drawn, over the vessel's size
const CLICK = 4; // points that the pointer may move in a click

const bytes = await (await fetch("recording/0")).arrayBuffer();
const length = new DataView(bytes).getUint32(0, true);
const vessel = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, length)));
const start = 4 + length;

const geometry = new BufferGeometry();
geometry.setAttribute("position", new BufferAttribute(new Float32Array(bytes, start, vessel.vertices), 3));
geometry.setIndex(new BufferAttribute(new Uint32Array(bytes, start + 4 * vessel.vertices), 1));
geometry.computeVertexNormals();
geometry.computeBoundingSphere();
const { center, radius: size } = geometry.boundingSphere ?? { center: new Vector3(), radius: 1 };

const canvas = /** @type {HTMLCanvasElement} */ (byId("picture"));
const renderer = new WebGLRenderer({ canvas, antialias: true });
const scene = new Scene();
scene.background = new Color(0x14171f);
const camera = new PerspectiveCamera(40, 1, size / 100, size * 50);
const light = new DirectionalLight(0xffffff, 2);
scene.add(new AmbientLight(0xffffff, 1.2), light, new Mesh(geometry, new MeshLambertMaterial({
  color: 0xb8998f, transparent: true, opacity: 0.45, side: DoubleSide, depthWrite: false })));

/** @type {Map<number, Mesh<CircleGeometry, MeshBasicMaterial>>} */
const discs = new Map();
/** @type {Map<number, HTMLButtonElement>} */
const buttons = new Map();
for (const end of /** @type {End[]} */ (vessel.ends)) {
  const disc = new Mesh(new CircleGeometry(Math.max(end.radius, LEAST_END * size), 32),
    new MeshBasicMaterial({ color: end.isOpen ? END : CLOSED, side: DoubleSide }));
  disc.position.fromArray(end.centre);
  disc.lookAt(disc.position.clone().add(new Vector3().fromArray(end.direction)));
  disc.userData.end = end;
  scene.add(disc);
  discs.set(end.number, disc);
  const button = make("button", { onclick: () => choose(end) }, `${end.number} ${end.name}`);
  button.title = `${end.isOpen ? "open" : "closed"}, radius ${end.radius.toPrecision(3)} mm`;
  button.setAttribute("aria-pressed", "false");
  buttons.set(end.number, button);
}
byId("ends").replaceChildren(...buttons.values());

vessel.places.forEach((/** @type {{name: string, points: number[]}} */ kind, /** @type {number} */ k) => {
  const points = new BufferGeometry();
  points.setAttribute("position", new BufferAttribute(new Float32Array(kind.points), 3));
  const colour = PLACES[k % PLACES.length];
  scene.add(new Points(points, new PointsMaterial({ color: colour, size: 9, sizeAttenuation: false, depthTest: false })));
  const swatch = make("i", { className: "swatch" });
  swatch.style.background = colour;
  byId("places").append(make("dt", {}, swatch, kind.name), make("dd", {}, String(kind.points.length / 3)));
});
byId("title").textContent = vessel.title;
byId("report").replaceChildren(...vessel.lines.map((/** @type {string} */ line) => make("li", {}, line)));

/** Makes an end the inlet, and says what was written. @param {End} end */
async function choose(end) {
  const answer = await fetch(`inlet/${end.number}`, { method: "POST" });
  byId("said").textContent = await answer.text();
  if (!answer.ok) return;
  for (const [number, disc] of discs) {
    const isInlet = number === end.number;
    disc.material.color.set(isInlet ? INLET : disc.userData.end.isOpen ? END : CLOSED);
    buttons.get(number)?.setAttribute("aria-pressed", String(isInlet));
  }
  ask();
}

const controls = new OrbitControls(camera, canvas);
controls.target.copy(center);
camera.position.copy(center).addScaledVector(new Vector3(0, 0, 1), 2.4 * size);
controls.update();
let drawn = 0;
let isRequested = false;
function ask() {
  if (isRequested) return;
  isRequested = true;
  requestAnimationFrame(() => {
    isRequested = false;
    const { clientWidth: width, clientHeight: height } = canvas;
    if (!width || !height) return;
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    light.position.copy(camera.position);
    renderer.render(scene, camera);
    drawn++;
  });
}
controls.addEventListener("change", ask);
new ResizeObserver(ask).observe(canvas);

const pressed = new Vector2();
canvas.addEventListener("pointerdown", (event) => pressed.set(event.clientX, event.clientY));
canvas.addEventListener("pointerup", (event) => {
  if (pressed.distanceTo(new Vector2(event.clientX, event.clientY)) > CLICK) return;
  const box = canvas.getBoundingClientRect();
  const ray = new Raycaster();
  ray.setFromCamera(new Vector2((2 * (event.clientX - box.left)) / box.width - 1,
    1 - (2 * (event.clientY - box.top)) / box.height), camera);
  const hit = ray.intersectObjects([...discs.values()])[0];
  if (hit) choose(hit.object.userData.end);
});

/** For scripts that drive this page: pictures so far, and where an end is on the screen, points. */
Object.assign(globalThis, { viewer: {
  get stage() { return { drawn }; },
  /** @param {number} number */
  placeOf(number) {
    const box = canvas.getBoundingClientRect();
    const at = discs.get(number)?.position.clone().project(camera) ?? new Vector3();
    return [box.left + (0.5 * (at.x + 1)) * box.width, box.top + 0.5 * (1 - at.y) * box.height];
  },
} });
