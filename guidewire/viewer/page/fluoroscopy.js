// @ts-check
import { CArm, UNKNOWN } from "./carm.js";
import { Lumen } from "./lumen.js";
import { NUMBERS, Pieces } from "./pieces.js";
import { BLUR, COMPOSE, COVER, SHOW, STRIP, STRIP_CORNERS } from "./shaders.js";

/** @typedef {import("./carm.js").Point} Point */
/** @typedef {import("./pieces.js").Instrument} Instrument */

/**
 * @typedef {object} Look
 * @property {number} lao degrees; RAO is negative
 * @property {number} cranial degrees; caudal is negative
 * @property {Point | null} centre units; null: the middle of what is framed
 * @property {number | null} field side of the picture, mm; null: all that is framed
 * @property {"roadmap" | "contrast" | "none"} vessel
 * @property {number} contrast 1/mm
 * @property {number} background
 * @property {number} noise deviation over brightness
 * @property {number} seed
 * @property {number} blur mm
 */

/** @returns {Look} */
export const plainLook = () => ({
  lao: 0, cranial: 0, centre: null, field: null, vessel: "roadmap", contrast: 0.1, background: 0.75, noise: 0, seed: 0,
  blur: 0,
});
/** Brightness over the background's, of what passes the contrast agent. */
const VESSELS = {
  none: () => 1,
  contrast: (/** @type {number} */ passed) => passed,
  roadmap: (/** @type {number} */ passed) => 1 + 0.3 * (1 - passed),
};
const MOST_WEIGHTS = 24;

/** X-ray pictures by the formula of the core, drawn by a shader. */
export class Fluoroscopy {
  /** @param {HTMLCanvasElement} canvas @param {number} pixels of a side */
  constructor(canvas, pixels) {
    this.canvas = canvas;
    this.pixels = pixels;
    canvas.width = canvas.height = pixels;
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, depth: false });
    if (!gl || !gl.getExtension("EXT_color_buffer_float")) {
      throw new Error("fluoroscopy needs WebGL 2 that draws into textures of floating-point numbers");
    }
    this._gl = gl;
    const isBlended = gl.getExtension("EXT_float_blend") !== null;
    this._pieces = new Pieces();
    /** @type {Lumen[]} */
    this._lumens = [];
    /** Lowest and highest corner of what is framed, units. @type {[Point, Point]} */
    this.box = [[0, 0, 0], [1, 1, 1]];
    this.millimetres = 1; // of a unit
    /** How the patient lies. @type {import("./carm.js").Patient} */
    this.patient = UNKNOWN;
    this.look = plainLook();
    this._seen = "";
    this._shown = "";
    this._thickness = new Float32Array(pixels * pixels);
    this._strip = program(gl, STRIP_CORNERS, STRIP);
    this._compose = program(gl, COVER, COMPOSE);
    this._blurred = program(gl, COVER, BLUR);
    this._show = program(gl, COVER, SHOW);
    this._layer = texture(gl, pixels, gl.R32F);
    this._depth = target(gl, pixels, isBlended ? gl.R32F : gl.R16F);
    this._first = target(gl, pixels, gl.R32F);
    this._second = target(gl, pixels, gl.R32F);
    this._numbers = gl.createBuffer();
    this._strips = gl.createVertexArray();
    gl.bindVertexArray(this._strips);
    gl.bindBuffer(gl.ARRAY_BUFFER, this._numbers);
    for (let k = 0; k < 3; k++) {
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, 4, gl.FLOAT, false, 4 * NUMBERS, 16 * k);
      gl.vertexAttribDivisor(k, 1);
    }
    this._nothing = gl.createVertexArray();
  }

  /**
   * Says what is seen.
   * @param {import("./recording.js").Wall[]} walls @param {[Point, Point]} box what is framed, units
   * @param {number} millimetres of a unit @param {import("./carm.js").Patient | null} [patient] null: unknown
   */
  set(walls, box, millimetres, patient = null) {
    this.patient = patient ?? UNKNOWN;
    this._lumens = walls.filter((wall) => wall.kind === "vessel").map((wall) => new Lumen(wall));
    this.box = box;
    this.millimetres = millimetres;
    this._seen = this._shown = "";
  }

  /** Where it is seen from. */
  get arm() {
    const { lao, cranial, centre, field } = this.look;
    const [low, high] = this.box;
    const middle = centre ?? /** @type {Point} */ (low.map((value, k) => 0.5 * (value + high[k])));
    const side = field === null ? CArm.framing(lao, cranial, low, high, this.patient) : field / this.millimetres;
    return new CArm(lao, cranial, middle, side, this.pixels, this.patient);
  }

  /** Draws. @param {[Instrument, ArrayLike<number>][]} instruments with the points of their centrelines, units */
  draw(instruments) {
    const { arm, look, _gl: gl } = this;
    this._setLayer(arm);
    this._pieces.clear();
    for (const [instrument, x] of instruments) this._pieces.add(instrument, x, arm);
    gl.viewport(0, 0, this.pixels, this.pixels);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this._depth.frame);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    this._drawStrips();
    gl.bindVertexArray(this._nothing);
    const blur = look.blur > 0 ? (look.blur / this.millimetres) * arm.scale : 0;
    gl.useProgram(this._compose);
    this._bind(this._compose, "layer", 0, this._layer);
    this._bind(this._compose, "depth", 1, this._depth.texture);
    gl.uniform1i(gl.getUniformLocation(this._compose, "isLast"), blur > 0 ? 0 : 1);
    this._setNoise(this._compose);
    this._cover(blur > 0 ? this._first.frame : null);
    if (blur > 0) {
      const weights = gaussian(blur, this.pixels);
      gl.useProgram(this._blurred);
      gl.uniform1fv(gl.getUniformLocation(this._blurred, "weights"), weights);
      gl.uniform1i(gl.getUniformLocation(this._blurred, "extent"), weights.length - 1);
      for (const [from, to, x, y] of /** @type {const} */ ([[this._first, this._second, 1, 0],
        [this._second, this._first, 0, 1]])) {
        this._bind(this._blurred, "picture", 0, from.texture);
        gl.uniform2i(gl.getUniformLocation(this._blurred, "along"), x, y);
        this._cover(to.frame);
      }
      gl.useProgram(this._show);
      this._bind(this._show, "picture", 0, this._first.texture);
      this._setNoise(this._show);
      this._cover(null);
    }
  }

  /** @param {WebGLProgram} of */
  _setNoise(of) {
    const { look, _gl: gl } = this;
    gl.uniform1f(gl.getUniformLocation(of, "noise"), look.noise * Math.sqrt(look.background));
    gl.uniform1ui(gl.getUniformLocation(of, "seed"), look.seed >>> 0);
  }

  /**
   * Draws and returns the grey levels, row by row from above.
   * @param {[Instrument, ArrayLike<number>][]} instruments
   */
  grey(instruments) {
    const { pixels, _gl: gl } = this;
    this.draw(instruments);
    const all = new Uint8Array(4 * pixels * pixels);
    gl.readPixels(0, 0, pixels, pixels, gl.RGBA, gl.UNSIGNED_BYTE, all);
    return Uint8Array.from({ length: pixels * pixels }, (_, k) =>
      all[4 * ((pixels - 1 - Math.floor(k / pixels)) * pixels + (k % pixels))]);
  }

  _drawStrips() {
    const { _gl: gl } = this;
    if (!this._pieces.count) return;
    gl.useProgram(this._strip);
    gl.bindVertexArray(this._strips);
    gl.bindBuffer(gl.ARRAY_BUFFER, this._numbers);
    gl.bufferData(gl.ARRAY_BUFFER, this._pieces.numbers.subarray(0, NUMBERS * this._pieces.count), gl.STREAM_DRAW);
    set(gl, this._strip, "pixels", this.pixels);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this._pieces.count);
    gl.disable(gl.BLEND);
  }

  /** Computes the brightness of background and vessel where they are seen anew or otherwise. @param {CArm} arm */
  _setLayer(arm) {
    const { lao, cranial, vessel, contrast, background } = this.look;
    const seen = [lao, cranial, ...arm.centre, arm.scale].join();
    if (seen !== this._seen) {
      this._thickness.fill(0);
      for (const lumen of this._lumens) lumen.add(arm, this._thickness);
    }
    const shown = [seen, vessel, contrast, background].join();
    if (shown === this._shown) return;
    this._seen = seen;
    this._shown = shown;
    const factor = VESSELS[vessel];
    const brightness = this._thickness.map((thickness) =>
      background * factor(Math.exp(-contrast * this.millimetres * thickness)));
    const { _gl: gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this._layer);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, this.pixels, this.pixels, gl.RED, gl.FLOAT, brightness);
  }

  /** @param {WebGLProgram} of @param {string} name @param {number} unit @param {WebGLTexture} image */
  _bind(of, name, unit, image) {
    const { _gl: gl } = this;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, image);
    gl.uniform1i(gl.getUniformLocation(of, name), unit);
  }

  /** @param {WebGLFramebuffer | null} frame */
  _cover(frame) {
    const { _gl: gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }
}

/** @param {WebGL2RenderingContext} gl @param {WebGLProgram} of @param {string} name @param {number} value */
function set(gl, of, name, value) {
  gl.uniform1f(gl.getUniformLocation(of, name), value);
}

/** @param {number} deviation pixels @param {number} pixels */
function gaussian(deviation, pixels) {
  const extent = Math.min(Math.ceil(3 * deviation), pixels, MOST_WEIGHTS - 1);
  const all = Array.from({ length: extent + 1 }, (_, k) => Math.exp((-0.5 * k * k) / (deviation * deviation)));
  const sum = all.reduce((total, weight) => total + 2 * weight, -1);
  return Float32Array.from(all, (weight) => weight / sum);
}

/** @param {WebGL2RenderingContext} gl @param {string} corners @param {string} fragments */
function program(gl, corners, fragments) {
  const made = gl.createProgram();
  for (const [kind, text] of /** @type {[number, string][]} */ ([[gl.VERTEX_SHADER, corners],
    [gl.FRAGMENT_SHADER, fragments]])) {
    const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader) ?? "shader");
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return made;
}

/** @param {WebGL2RenderingContext} gl @param {number} pixels @param {number} format */
function texture(gl, pixels, format) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, pixels, pixels);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return made;
}

/** @param {WebGL2RenderingContext} gl @param {number} pixels @param {number} format */
function target(gl, pixels, format) {
  const image = texture(gl, pixels, format);
  const frame = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, image, 0);
  return { texture: image, frame };
}
