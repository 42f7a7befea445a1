// @ts-check
import {
  AmbientLight, Box3, Camera, Color, ColorManagement, CustomBlending, DirectionalLight, GLSL3, LinearSRGBColorSpace,
  Mesh, NoBlending, OneFactor, OneMinusSrcAlphaFactor, PerspectiveCamera, PlaneGeometry, RawShaderMaterial, Scene,
  Vector2, Vector3, WebGLRenderer, WebGLRenderTarget,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { BEFORE, BEHIND } from "./model.js";

/** @typedef {import("./model.js").Model} Model */

/** @type {Record<string, import("three").Color>} */
const BACKGROUNDS = { dark: new Color(15 / 255, 22 / 255, 30 / 255), light: new Color(228 / 255, 234 / 255, 238 / 255) };

/** Points of a texture where they stand. */
const COPY = `precision mediump float;
uniform lowp sampler2D map;
uniform vec2 origin;
uniform float fraction;
out lowp vec4 colour;
void main() { colour = texelFetch(map, ivec2((gl_FragCoord.xy - origin) * fraction), 0); }`;
const COARSE = 0.5; // points of walls a point of the picture, while the camera moves
const AT_REST = 200; // ms after which it does not
const CLOSE_UP = 0.22; // of what the wire passes and the vessel: what a close-up shows
const LEAVING = 0.25; // of the picture: so far the tip goes from its middle until the camera follows
const STEEPEST = Math.PI / 6; // of the view from the head's side: as far as a C-arm tilts
const FARTHEST = 1e9; // units: what is beyond has diverged, and is not looked for
const SPREAD = 0.8; // of the half of a picture: so far from its middle the tips of two runs are shown
const EASE = 0.2; // of the distance that the camera follows in a picture

/**
 * Part of the picture. Walls are drawn when the camera moves, and kept: all of them as what is behind the wire, and
 * those before it as what tints it.
 */
class Pane {
  /** @param {Model[]} models */
  constructor(models) {
    this.models = models;
    this.scene = new Scene();
    this.behind = new WebGLRenderTarget(1, 1, { samples: 4 });
    this.before = new WebGLRenderTarget(1, 1, { samples: 4, depthBuffer: false });
    this.coarse = new WebGLRenderTarget(1, 1);
    this.isCoarse = false;
    /** Lower left corner in the picture, points. */
    this.origin = new Vector2();
    this.backdrop = copyOf(this.behind, this.origin, NoBlending);
    this.tint = copyOf(this.before, new Vector2(), CustomBlending);
    for (const { tint } of models) {
      tint.before.value = this.before.texture;
      tint.origin.value = this.origin;
    }
    /** What the walls were drawn for. */
    this.seen = "";
    const light = new AmbientLight(0xffffff, 1.5);
    light.layers.enableAll();
    this.scene.add(light, ...models.map((model) => model.group));
  }

  /** Chooses the walls of the backdrop. @param {boolean} isCoarse */
  take(isCoarse) {
    this.isCoarse = isCoarse;
    const { map, fraction } = this.backdrop.uniforms;
    map.value = (isCoarse ? this.coarse : this.behind).texture;
    fraction.value = isCoarse ? COARSE : 1;
  }

  dispose() {
    for (const target of [this.behind, this.before, this.coarse]) target.dispose();
  }
}

/**
 * A scene that copies what was drawn; its alpha is in its colours.
 * @param {WebGLRenderTarget} target @param {Vector2} origin where it stands, points
 * @param {import("three").Blending} blending
 */
function copyOf(target, origin, blending) {
  const uniforms = { map: { value: target.texture }, origin: { value: origin }, fraction: { value: 1 } };
  const quad = new Mesh(new PlaneGeometry(2, 2), new RawShaderMaterial({
    glslVersion: GLSL3, uniforms, fragmentShader: COPY,
    vertexShader: "in vec3 position; void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }",
    depthTest: false, depthWrite: false, transparent: true,
    blending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor,
  }));
  quad.frustumCulled = false;
  return { uniforms, scene: new Scene().add(quad) };
}

/** The picture: one pane, or two side by side with the same camera. */
export class Stage {
  /** @param {HTMLCanvasElement} canvas @param {HTMLElement} labels takes a text for each pane */
  constructor(canvas, labels) {
    this._canvas = canvas;
    this._labels = labels;
    ColorManagement.enabled = false; // colours are what the screen shows, in layers as on their own
    this._isSlow = isDrawnBySoftware();
    /** Null where there is no WebGL. @type {any} */
    this._renderer = makeRenderer(canvas, !this._isSlow);
    this._flat = new Camera();
    this._camera = new PerspectiveCamera(40, 1, 0.1, 1000);
    this._camera.up.set(0, 0, 1);
    this._controls = this._control();
    /** Towards whoever looks, of unit length; as the X-ray picture's detector. */
    this._towards = new Vector3(1, 0, 0);
    /** Told where the picture is turned by hand. @type {(towards: number[]) => void} */
    this.onTurned = () => {};
    this._light = new DirectionalLight(0xffffff, 2.2);
    this._light.layers.enableAll();
    /** @type {Pane[]} */
    this._panes = [];
    /** @type {Model[]} */
    this._models = [];
    this._isRequested = false;
    this._rest = 0; // timer
    this.followsTip = true;
    this._background = BACKGROUNDS.dark;
    this._isFollowing = this._isTurning = false;
    /** Pictures drawn so far. */
    this.drawn = 0;
    /** Told after every picture. @type {() => void} */
    this.onDrawn = () => {};
    /** Told where wires are drawn thicker or thinner, since the camera went nearer or farther. @type {() => void} */
    this.onThickness = () => {};
    new ResizeObserver(() => this.ask()).observe(canvas);
  }

  /** @param {string} theme "dark" or "light" */
  setTheme(theme) {
    this._background = BACKGROUNDS[theme];
    for (const pane of this._panes) pane.seen = "";
    this.ask();
  }

  /** Whether anything can be drawn here. */
  get isDrawn() {
    return this._renderer !== null;
  }

  /** The mouse's hold of the camera; it takes what is above from the camera once. */
  _control() {
    const controls = new OrbitControls(this._camera, this._canvas);
    controls.addEventListener("change", () => this.ask());
    controls.addEventListener("start", () => this._towards.copy(this._camera.position).sub(controls.target).normalize());
    controls.addEventListener("change", () => {
      const towards = this._camera.position.clone().sub(controls.target).normalize();
      if (!this._isTurning && towards.distanceTo(this._towards) > 1e-6) this.onTurned(towards.toArray());
      this._towards.copy(towards);
    });
    [controls.minPolarAngle, controls.maxPolarAngle] = [STEEPEST, Math.PI - STEEPEST];
    return controls;
  }

  /** Looks as a C-arm does, at what it looks at now. @param {import("./carm.js").CArm | null} arm */
  look(arm) {
    if (!arm) return;
    const { target } = this._controls;
    const away = this._camera.position.distanceTo(target) || 1;
    const above = new Vector3().fromArray(arm.head);
    if (above.distanceTo(this._camera.up) > 1e-6) {
      this._camera.up.copy(above);
      this._controls.dispose();
      const before = target.clone();
      this._controls = this._control();
      this._controls.target.copy(before);
    }
    this._towards.fromArray(arm.towards);
    this._camera.position.copy(this._controls.target).addScaledVector(this._towards, away);
    this._isTurning = true;
    this._controls.update();
    this._isTurning = false;
    this.ask();
  }

  /** Says what is shown. @param {Model[][]} panes the runs of each pane */
  set(panes) {
    this._models = panes.flat();
    for (const pane of this._panes) pane.dispose();
    this._panes = panes.map((models) => new Pane(models));
    this._labels.replaceChildren(...panes.map(() => document.createElement("div")));
    this.ask();
  }

  /** Writes into a pane's corner. @param {number} pane @param {string} text */
  label(pane, text) {
    const place = this._labels.children[pane];
    if (place) place.textContent = text;
  }

  /** Moves the camera so that all places are seen that wires pass. @param {boolean} [withWalls] walls too */
  frameAll(withWalls = false) {
    const box = new Box3();
    const point = new Vector3();
    for (const { recording } of this._models) {
      const isSeen = outOfSheath(recording.sheath);
      const positions = recording.channel("positions");
      const places = [positions.values.subarray(0, recording.count * positions.width),
        ...(withWalls ? recording.walls.map((wall) => wall.vertices) : [])];
      for (const all of places) {
        for (let k = 0; k < all.length; k += 3) {
          point.fromArray(all, k);
          if (point.length() < FARTHEST && isSeen(point)) box.expandByPoint(point);
        }
      }
    }
    const size = Math.max(box.getSize(point).length(), 1e-6);
    box.getCenter(this._controls.target);
    this._camera.near = size / 1000;
    this._camera.far = size * 50;
    const upward = Math.tan((0.5 * this._camera.fov * Math.PI) / 180);
    const aspect = this._canvas.clientWidth / Math.max(this._panes.length, 1) / Math.max(this._canvas.clientHeight, 1);
    const { middle, spread } = this._tips;
    const half = this.followsTip ? Math.max(0.5 * size * CLOSE_UP, spread / SPREAD) : 0.5 * size;
    const distance = half / Math.sin(Math.atan(upward * Math.min(aspect || 1, 1)));
    if (this.followsTip) this._controls.target.copy(middle);
    this._camera.position.copy(this._controls.target).addScaledVector(this._towards, distance);
    this._isTurning = true;
    this._controls.update();
    this._isTurning = false;
    this.ask();
  }

  /** The middle of the tips of all runs, which every pane shows, and how far they are from it, units. */
  get _tips() {
    const tips = this._models.map(({ watchedTip }) => new Vector3().fromArray(watchedTip))
      .filter((tip) => tip.length() < FARTHEST);
    const middle = tips.reduce((sum, tip) => sum.addScaledVector(tip, 1 / tips.length), new Vector3());
    return { middle: tips.length ? middle : new Vector3(NaN, NaN, NaN), spread: Math.max(0, ...tips.map((tip) => tip.distanceTo(middle))) };
  }

  /** Asks for a picture when the screen takes the next one. */
  ask() {
    if (this._isRequested) return;
    this._isRequested = true;
    requestAnimationFrame(() => {
      this._isRequested = false;
      this._draw();
    });
  }

  _draw() {
    const width = this._canvas.clientWidth;
    const height = this._canvas.clientHeight;
    if (!width || !height || !this._panes.length || !this._renderer) return;
    const before = this._renderer.getSize(new Vector2()); // set anew it costs as much as a picture
    if (width !== before.x || height !== before.y) this._renderer.setSize(width, height, false);
    if (this.followsTip) this._follow();
    const paneWidth = Math.floor(width / this._panes.length);
    this._camera.aspect = paneWidth / height;
    this._camera.updateProjectionMatrix();
    this._camera.updateMatrixWorld();
    this._light.position.copy(this._camera.position).sub(this._controls.target);
    const away = this._camera.position.distanceTo(this._controls.target);
    const unitsPerPoint = (2 * away * Math.tan((0.5 * this._camera.fov * Math.PI) / 180)) / height;
    if (this._models.filter((model) => model.takeScale(unitsPerPoint)).length) this.onThickness();
    this._panes.forEach((pane, k) => {
      pane.scene.add(this._light);
      const shown = pane.models.flatMap(({ walls, patient, recording }) => [walls.visible, patient.visible, recording.moves]);
      const seen = [...this._camera.matrixWorld.elements, paneWidth, height, ...shown].join();
      if (seen !== pane.seen && this._isSlow && pane.seen) this._drawCoarseWalls(pane, paneWidth, height);
      else if (seen !== pane.seen) this._drawWalls(pane, paneWidth, height);
      pane.seen = seen;
      this._renderer.setViewport(k * paneWidth, 0, paneWidth, height);
      this._renderer.setScissor(k * paneWidth, 0, paneWidth, height);
      pane.origin.set(k * paneWidth, 0);
      this._camera.layers.set(0);
      this._renderer.clear(false, true);
      this._renderer.render(pane.backdrop.scene, this._flat);
      this._renderer.render(pane.scene, this._camera);
    });
    this.drawn++;
    this.onDrawn();
  }

  /** @param {Pane} pane @param {number} width @param {number} height */
  _drawWalls(pane, width, height) {
    this._drawLayer(pane, pane.behind, BEHIND, width, height);
    this._drawLayer(pane, pane.before, BEFORE, width, height);
    this._renderer.setRenderTarget(pane.behind);
    this._renderer.render(pane.tint.scene, this._flat);
    this._renderer.setRenderTarget(null);
    pane.take(false);
  }

  /** Far walls in coarse points, and all of them well when the camera rests. @param {Pane} pane @param {number} width
   * @param {number} height */
  _drawCoarseWalls(pane, width, height) {
    if (!pane.isCoarse) this._drawLayer(pane, pane.before, null, width, height);
    this._drawLayer(pane, pane.coarse, BEHIND, Math.ceil(COARSE * width), Math.ceil(COARSE * height));
    this._renderer.setRenderTarget(null);
    pane.take(true);
    clearTimeout(this._rest);
    this._rest = setTimeout(() => {
      for (const one of this._panes) one.seen = "";
      this.ask();
    }, AT_REST);
  }

  /**
   * @param {Pane} pane @param {WebGLRenderTarget} target @param {number | null} layer null: nothing is drawn
   * @param {number} width @param {number} height
   */
  _drawLayer(pane, target, layer, width, height) {
    target.setSize(width, height);
    this._renderer.setRenderTarget(target);
    const isAll = target !== pane.before; // else it lies over what else there is
    this._renderer.setClearColor(isAll ? this._background : 0x000000, isAll ? 1 : 0);
    this._renderer.clear();
    if (layer === null) return;
    this._camera.layers.set(layer);
    this._renderer.render(pane.scene, this._camera);
  }

  /** Moves the camera where the tip is about to leave the picture: not in each, as walls are drawn anew then. */
  _follow() {
    const { middle, spread } = this._tips;
    const shift = middle.clone().sub(this._controls.target);
    if (!Number.isFinite(shift.x)) return;
    const upward = Math.tan((0.5 * this._camera.fov * Math.PI) / 180) * Math.min(this._camera.aspect, 1);
    const near = this._camera.position.distanceTo(this._controls.target);
    const away = Math.max(near, spread / (SPREAD * upward));
    if (away > near) this._camera.position.sub(this._controls.target).setLength(away).add(this._controls.target);
    const shown = 2 * away * Math.tan((0.5 * this._camera.fov * Math.PI) / 180);
    if (!this._isFollowing && shift.length() < LEAVING * shown) return;
    this._isFollowing = shift.length() > 0.02 * shown && !this._isSlow;
    if (this._isFollowing) {
      shift.multiplyScalar(EASE);
      this.ask();
    }
    this._controls.target.add(shift);
    this._camera.position.add(shift);
    this._camera.lookAt(this._controls.target);
  }
}

/**
 * Whether a place is beyond a sheath's end: what is in it is not looked at.
 * @param {[number[], number[]] | null} sheath its end, and where it is seen to begin
 * @returns {(point: Vector3) => boolean}
 */
function outOfSheath(sheath) {
  if (!sheath) return () => true;
  const exit = new Vector3().fromArray(sheath[0]);
  const along = exit.clone().sub(new Vector3().fromArray(sheath[1])).normalize();
  const least = along.dot(exit) - 1e-6 * (1 + exit.length());
  return (point) => along.dot(point) >= least;
}

/** @param {HTMLCanvasElement} canvas @param {boolean} antialias @returns {WebGLRenderer | null} null without WebGL */
function makeRenderer(canvas, antialias) {
  try {
    const renderer = new WebGLRenderer({ canvas, antialias });
    renderer.outputColorSpace = LinearSRGBColorSpace;
    renderer.setScissorTest(true);
    renderer.autoClear = false;
    return renderer;
  } catch (error) {
    console.info(`no 3D picture: ${error}`);
    return null;
  }
}

/** Whether no graphics card draws here: smooth edges then cost as much as all else. */
function isDrawnBySoftware() {
  const context = document.createElement("canvas").getContext("webgl2");
  const names = context?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? context?.getParameter(names.UNMASKED_RENDERER_WEBGL) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
