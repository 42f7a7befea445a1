// @ts-check
import { View } from "./look.js";
import { NUMBERS, Pieces } from "./pieces.js";
import { COMPOSE, COVER, STRIP, STRIP_CORNERS } from "./shaders.js";

/** @typedef {import("./pieces.js").Instrument} Instrument */

const LIGHT_BELOW = 0.46; // brightness from which black and white are as easily told: luminance 0.18, (1.05/0.23 = 0.23/0.05)

/** X-ray pictures by the formula of the core, drawn by a shader. */
export class Fluoroscopy extends View {
  /** @param {HTMLCanvasElement} canvas @param {number} pixels of a side */
  constructor(canvas, pixels) {
    super(canvas);
    const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, depth: false });
    if (!gl || !gl.getExtension("EXT_color_buffer_float")) {
      throw new Error("fluoroscopy needs WebGL 2 that draws into textures of floating-point numbers");
    }
    this._gl = gl;
    this._pieces = new Pieces();
    this._strip = program(gl, STRIP_CORNERS, STRIP);
    this._compose = program(gl, COVER, COMPOSE);
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
    super.resize(pixels, pixels);
    this._images = imagesOf(gl, pixels, pixels);
    /** What the mask was seen from. @type {string | null} */
    this._maskSeen = null;
  }

  /** @param {number} columns of pixels @param {number} rows @returns {boolean} whether that is another size */
  resize(columns, rows) {
    if (!super.resize(columns, rows)) return false;
    const { _gl: gl } = this;
    const { layer, ...targets } = this._images;
    gl.deleteTexture(layer);
    for (const { texture: image, frame } of Object.values(targets)) {
      gl.deleteTexture(image);
      gl.deleteFramebuffer(frame);
    }
    this._maskSeen = null;
    this._images = imagesOf(gl, columns, rows);
    return true;
  }

  /** Takes the picture that later ones are subtracted from. @param {[Instrument, ArrayLike<number>][]} instruments */
  takeMask(instruments) {
    const { look } = this;
    this.look = { ...look, isSubtracted: false };
    this._draw(instruments, this._images.mask.frame);
    this.look = look;
    this._maskSeen = this._seen;
  }

  /** Whether the mask is of what is seen now. */
  get hasMask() {
    return this._maskSeen === this._seen;
  }

  /** Draws. @param {[Instrument, ArrayLike<number>][]} instruments with the points of their centrelines, units
   * @param {boolean} isClear whether instruments are light where what is behind them is dark */
  draw(instruments, isClear = false) {
    this._draw(instruments, null, isClear);
  }

  /** @param {[Instrument, ArrayLike<number>][]} instruments @param {WebGLFramebuffer | null} mask takes brightness alone
   * @param {boolean} isClear */
  _draw(instruments, mask, isClear = false) {
    const { arm, look, _gl: gl } = this;
    this._setLayer(arm);
    this._pieces.clear();
    for (const [instrument, x] of instruments) this._pieces.add(instrument, x, arm);
    gl.viewport(0, 0, this.columns, this.rows);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this._images.depth.frame);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    this._drawStrips();
    gl.bindVertexArray(this._nothing);
    gl.useProgram(this._compose);
    this._bind(this._compose, "layer", 0, this._images.layer);
    this._bind(this._compose, "depth", 1, this._images.depth.texture);
    gl.uniform1i(gl.getUniformLocation(this._compose, "isLast"), mask ? 0 : 1);
    this._bind(this._compose, "mask", 2, mask ? this._images.layer : this._images.mask.texture);
    const isSubtracted = look.isSubtracted && this.hasMask && !mask;
    gl.uniform1f(gl.getUniformLocation(this._compose, "subtracted"), isSubtracted ? look.background : 0);
    gl.uniform1f(gl.getUniformLocation(this._compose, "clear"), isClear && !isSubtracted ? LIGHT_BELOW : 0);
    gl.uniform2i(gl.getUniformLocation(this._compose, "shift"), look.shift[0], -look.shift[1]);
    gl.uniform1f(gl.getUniformLocation(this._compose, "noise"), look.noise * Math.sqrt(look.background));
    gl.uniform1ui(gl.getUniformLocation(this._compose, "seed"), look.seed >>> 0);
    this._cover(mask);
  }

  /**
   * Draws and returns the grey levels, row by row from above.
   * @param {[Instrument, ArrayLike<number>][]} instruments @param {boolean} isClear as of `draw`
   */
  grey(instruments, isClear = false) {
    const { columns, rows, _gl: gl } = this;
    this.draw(instruments, isClear);
    const all = new Uint8Array(4 * columns * rows);
    gl.readPixels(0, 0, columns, rows, gl.RGBA, gl.UNSIGNED_BYTE, all);
    return Uint8Array.from({ length: columns * rows }, (_, k) =>
      all[4 * ((rows - 1 - Math.floor(k / columns)) * columns + (k % columns))]);
  }

  _drawStrips() {
    const { _gl: gl } = this;
    if (!this._pieces.count) return;
    gl.useProgram(this._strip);
    gl.bindVertexArray(this._strips);
    gl.bindBuffer(gl.ARRAY_BUFFER, this._numbers);
    gl.bufferData(gl.ARRAY_BUFFER, this._pieces.numbers.subarray(0, NUMBERS * this._pieces.count), gl.STREAM_DRAW);
    gl.uniform2f(gl.getUniformLocation(this._strip, "pixels"), this.columns, this.rows);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this._pieces.count);
    gl.disable(gl.BLEND);
  }

  /** @param {import("./carm.js").CArm} arm */
  _setLayer(arm) {
    if (!this._setBrightness(arm)) return;
    const { _gl: gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this._images.layer);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, this.columns, this.rows, gl.RED, gl.FLOAT, this._brightness);
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

/** @param {WebGL2RenderingContext} gl @param {number} columns @param {number} rows
 * @param {number} format */
function texture(gl, columns, rows, format) {
  const made = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, columns, rows);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return made;
}

/** @param {WebGL2RenderingContext} gl @param {number} columns @param {number} rows
 * @param {number} format */
function target(gl, columns, rows, format) {
  const image = texture(gl, columns, rows, format);
  const frame = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, image, 0);
  return { texture: image, frame };
}

/** What a picture is made of. @param {WebGL2RenderingContext} gl @param {number} columns @param {number} rows */
function imagesOf(gl, columns, rows) {
  const made = (/** @type {number} */ format) => target(gl, columns, rows, format);
  return { layer: texture(gl, columns, rows, gl.R32F), depth: made(gl.getExtension("EXT_float_blend") ? gl.R32F : gl.R16F),
    mask: made(gl.R32F) };
}
