// @ts-check
import {
  AmbientLight, Box3, Color, ColorManagement, CustomBlending, DirectionalLight, LinearSRGBColorSpace, Mesh,
  MeshBasicMaterial, OneFactor, OneMinusSrcAlphaFactor, OrthographicCamera, PerspectiveCamera, PlaneGeometry, Scene,
  Vector3, WebGLRenderer, WebGLRenderTarget,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { BEFORE, BEHIND } from "./model.js";

/** @typedef {import("./model.js").Model} Model */

const BACKGROUND = new Color(20 / 255, 23 / 255, 31 / 255);

/** Part of the picture. Walls behind the wire and before it are drawn when the camera moves, and kept. */
class Pane {
  /** @param {Model[]} models */
  constructor(models) {
    this.models = models;
    this.scene = new Scene();
    this.behind = new WebGLRenderTarget(1, 1, { samples: 4 });
    this.before = new WebGLRenderTarget(1, 1, { samples: 4, depthBuffer: false });
    this.tint = new Scene();
    this.tint.add(new Mesh(new PlaneGeometry(2, 2), new MeshBasicMaterial({
      map: this.before.texture, transparent: true, depthTest: false, depthWrite: false,
      blending: CustomBlending, blendSrc: OneFactor, blendDst: OneMinusSrcAlphaFactor, // alpha is in what was drawn
    })));
    /** What the walls were drawn for. */
    this.seen = "";
    const light = new AmbientLight(0xffffff, 1.5);
    light.layers.enableAll();
    this.scene.add(light, ...models.map((model) => model.group));
  }

  dispose() {
    this.behind.dispose();
    this.before.dispose();
  }
}

/** The picture: one pane, or two side by side with the same camera. */
export class Stage {
  /** @param {HTMLCanvasElement} canvas @param {HTMLElement} labels takes a text for each pane */
  constructor(canvas, labels) {
    this._canvas = canvas;
    this._labels = labels;
    ColorManagement.enabled = false; // colours are what the screen shows, in layers as on their own
    this._renderer = new WebGLRenderer({ canvas, antialias: !isDrawnBySoftware() });
    this._renderer.outputColorSpace = LinearSRGBColorSpace;
    this._renderer.setScissorTest(true);
    this._renderer.autoClear = false;
    this._flat = new OrthographicCamera(-1, 1, 1, -1, -1, 1);
    this._camera = new PerspectiveCamera(40, 1, 0.1, 1000);
    this._camera.up.set(0, 1, 0);
    this._controls = new OrbitControls(this._camera, canvas);
    this._controls.addEventListener("change", () => this.ask());
    this._light = new DirectionalLight(0xffffff, 2.2);
    this._light.layers.enableAll();
    /** @type {Pane[]} */
    this._panes = [];
    /** @type {Model[]} */
    this._models = [];
    this._isAsked = false;
    this.followsTip = false;
    /** Pictures drawn so far. */
    this.drawn = 0;
    /** Told after every picture. @type {() => void} */
    this.onDrawn = () => {};
    new ResizeObserver(() => this.ask()).observe(canvas);
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
          if (Number.isFinite(point.x) && isSeen(point)) box.expandByPoint(point);
        }
      }
    }
    const size = Math.max(box.getSize(point).length(), 1e-6);
    box.getCenter(this._controls.target);
    this._camera.near = size / 1000;
    this._camera.far = size * 50;
    const upward = Math.tan((0.5 * this._camera.fov * Math.PI) / 180);
    const aspect = this._canvas.clientWidth / Math.max(this._panes.length, 1) / Math.max(this._canvas.clientHeight, 1);
    const distance = (0.5 * size) / Math.sin(Math.atan(upward * Math.min(aspect || 1, 1)));
    this._camera.position.copy(this._controls.target).addScaledVector(new Vector3(-0.96, 0.28, 0), distance);
    this._controls.update();
    this.ask();
  }

  /** Asks for a picture when the screen takes the next one. */
  ask() {
    if (this._isAsked) return;
    this._isAsked = true;
    requestAnimationFrame(() => {
      this._isAsked = false;
      this._draw();
    });
  }

  _draw() {
    const width = this._canvas.clientWidth;
    const height = this._canvas.clientHeight;
    if (!width || !height || !this._panes.length) return;
    this._renderer.setSize(width, height, false);
    if (this.followsTip) this._follow();
    const share = Math.floor(width / this._panes.length);
    this._camera.aspect = share / height;
    this._camera.updateProjectionMatrix();
    this._camera.updateMatrixWorld();
    this._light.position.copy(this._camera.position).sub(this._controls.target);
    this._panes.forEach((pane, k) => {
      pane.scene.add(this._light);
      const shown = pane.models.map((model) => model.walls.visible);
      const seen = [...this._camera.matrixWorld.elements, share, height, ...shown].join();
      if (seen !== pane.seen) this._drawWalls(pane, share, height);
      pane.seen = seen;
      this._renderer.setViewport(k * share, 0, share, height);
      this._renderer.setScissor(k * share, 0, share, height);
      pane.scene.background = pane.behind.texture;
      this._camera.layers.set(0);
      this._renderer.clear();
      this._renderer.render(pane.scene, this._camera);
      this._renderer.render(pane.tint, this._flat);
    });
    this.drawn++;
    this.onDrawn();
  }

  /** @param {Pane} pane @param {number} width @param {number} height */
  _drawWalls(pane, width, height) {
    pane.scene.background = null;
    for (const [target, layer, alpha] of /** @type {[WebGLRenderTarget, number, number][]} */ (
      [[pane.behind, BEHIND, 1], [pane.before, BEFORE, 0]])) {
      target.setSize(width, height);
      this._camera.layers.set(layer);
      this._renderer.setRenderTarget(target);
      this._renderer.setClearColor(alpha ? BACKGROUND : 0x000000, alpha);
      this._renderer.clear();
      this._renderer.render(pane.scene, this._camera);
    }
    this._renderer.setRenderTarget(null);
  }

  _follow() {
    const shift = new Vector3().fromArray(this._models[0].tip).sub(this._controls.target);
    if (!Number.isFinite(shift.x)) return;
    this._controls.target.add(shift);
    this._camera.position.add(shift);
    this._camera.lookAt(this._controls.target);
  }
}

/**
 * Whether a place is beyond a sheath's end: what is in it is not looked at.
 * @param {[number[], number[]] | null} sheath its end, and where it is seen to begin @returns {(point: Vector3) => boolean}
 */
function outOfSheath(sheath) {
  if (!sheath) return () => true;
  const exit = new Vector3().fromArray(sheath[0]);
  const along = exit.clone().sub(new Vector3().fromArray(sheath[1])).normalize();
  const least = along.dot(exit) - 1e-6 * (1 + exit.length());
  return (point) => along.dot(point) >= least;
}

/** Whether no graphics card draws here: smooth edges then cost as much as all else. */
function isDrawnBySoftware() {
  const context = document.createElement("canvas").getContext("webgl2");
  const names = context?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? context?.getParameter(names.UNMASKED_RENDERER_WEBGL) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}
