// @ts-check
import { brief, drawScale } from "./colours.js";
import { drawCurves } from "./curves.js";
import { say } from "./words.js";

/** @typedef {import("./model.js").Model} Model */

const BETWEEN_CURVES = 100; // ms
/** What curves are drawn over: label, unit, and how many of that the channel's is. @type {Record<string, [string, string, number]>} */
const OVER = { time: ["time", "s", 1], hubInsertion: ["insertion", "mm", 1000], hubTurn: ["rotation of the hub", "degrees", 180 / Math.PI] };
const RELIABLE = /^([^:]*: )?(finished|converged), reliable:/;

/** @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);

/**
 * An element with properties and children. Texts of the page are put into its language.
 * @param {string} tag @param {Record<string, any>} properties @param {...(Node | string)} children @returns {any}
 */
export function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  if (properties.title) element.title = say(properties.title);
  element.append(...children.map((child) => (typeof child === "string" ? say(child) : child)));
  return element;
}

/** The same with a name that readers of the screen say. @param {string} tag @param {string} name
 * @param {Record<string, any>} properties @param {...(Node | string)} children @returns {any} */
export function named(tag, name, properties, ...children) {
  const element = make(tag, properties, ...children);
  element.setAttribute("aria-label", say(name));
  return element;
}

/** What opens over the page by a button, and closes with a click elsewhere or Escape. @param {string} id
 * @param {string} name of the button @param {...Node} children */
export function menu(id, name, ...children) {
  return make("details", { id }, named("summary", name, { className: "key", title: name }, "⋯"),
    make("div", { className: "sheet" }, ...children));
}

/** What stands beside the picture: what colours the wire, curves, facts. */
export class Panel {
  /**
   * @param {import("./stage.js").Stage} stage
   * @param {() => void} changed called when something else is to be shown
   */
  constructor(stage, changed) {
    this._stage = stage;
    /** @type {Model[]} */
    this.models = [];
    /** @type {number[]} */
    this._frames = [];
    this._full = 1;
    this._drawn = -BETWEEN_CURVES;
    this._isWaiting = false;
    this._coloured = 1; // how many of them take the colours; the others are plain
    for (const id of ["colour", "over", "first", "second", "thickness"]) byId(id).onchange = changed;
    for (const id of ["walls", "patient", "arrows", "follow"]) byId(id).onchange = changed;
    byId("wire").ontoggle = changed;
    stage.onThickness = () => this._showThickness();
  }

  /** @param {Model[]} models @param {boolean} areOver whether the second lies over the first in one picture */
  set(models, areOver) {
    const [{ recording }] = models;
    this.models = models;
    this._coloured = areOver ? 1 : models.length;
    const channels = [...recording.channels.values()];
    const along = channels.filter((channel) => channel.place === "sphere" || channel.place === "element");
    const overTime = channels.filter((channel) => channel.place === "frame" && channel.label);
    fill(byId("colour"), [["", "metal"], ...along.map((channel) => [channel.name, channel.label])], 0);
    fill(byId("over"), Object.entries(OVER).filter(([name]) => recording.channels.has(name)).map(([name, [label]]) => [name, label]), 0);
    if (models.length > 1) byId("wire").open = true;
    fill(byId("first"), overTime.map((channel) => [channel.name, channel.label]), 0);
    fill(byId("second"), overTime.map((channel) => [channel.name, channel.label]), 1);
    byId("facts").replaceChildren(...models.flatMap((model) => [
      ["run", model.recording.title], ["outcome", model.recording.outcome], ...model.recording.facts,
    ]).flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
    this.say(models.flatMap(({ recording: { title, outcome, warnings } }) =>
      [outcome, ...warnings].filter(Boolean).map((line) => (models.length > 1 ? `${title}: ${line}` : line))));
  }

  /** @param {string[]} lines what a user has to know; nothing bad where they are the ends of reliable runs alone */
  say(lines) {
    byId("said").textContent = lines.join("\n");
    byId("said").classList.toggle("good", lines.length > 0 && lines.every((line) => RELIABLE.test(line)));
  }

  /** @param {string[]} lines of what went well */
  tell(lines) {
    this.say(lines);
    byId("said").classList.add("good");
  }

  _showThickness() {
    const [model] = this.models;
    if (!model) return;
    const times = model.shownThickness;
    byId("thicker").textContent = times > 1 ? say("drawn with {0} times its true radius", brief(times, 2)) : "";
  }

  /** Takes the next of the colours. */
  nextColour() {
    const choice = byId("colour");
    choice.selectedIndex = (choice.selectedIndex + 1) % choice.options.length;
    choice.onchange();
  }

  /**
   * Puts what is chosen into the models and asks for a picture.
   * @param {number[]} frames of each model
   */
  show(frames) {
    const name = byId("colour").value;
    const coloured = this.models.slice(0, this._coloured).filter((model) => model.recording.channels.has(name));
    const full = coloured.length ? Math.max(...coloured.map((model) => model.full(name))) : 1;
    this.models.forEach((model, k) => {
      model.colour = k < this._coloured ? name : "";
      model.isPlain = k >= this._coloured;
      model.thickness = Number(byId("thickness").value) || null;
      model.walls.visible = byId("walls").checked && (k === 0 || this._coloured > 1);
      model.patient.visible = byId("patient").checked && (k === 0 || this._coloured > 1);
      model.arrows.visible = byId("arrows").checked;
      model.show(frames[k], full);
    });
    this._showThickness();
    if (this._stage.followsTip !== byId("follow").checked) {
      this._stage.followsTip = byId("follow").checked;
      this._stage.frameAll(true);
    }
    this._stage.ask();
    this._frames = frames;
    this._full = full;
    if (this._isWaiting || !byId("wire").open) return; // curves cost as much as a picture, and need not be as quick
    this._isWaiting = true;
    setTimeout(() => {
      this._isWaiting = false;
      this._drawCurves(this._frames, this._full);
    }, this._drawn + BETWEEN_CURVES - performance.now());
  }

  /** @param {number[]} frames @param {number} full */
  _drawCurves(frames, full) {
    this._drawn = performance.now();
    const name = byId("colour").value;
    drawScale(byId("scale"), name ? this.models[0].recording.channel(name) : null, full);
    this._drawAlong(frames);
    this._drawOverTime("first");
    this._drawOverTime("second");
  }

  /** @param {number[]} frames */
  _drawAlong(frames) {
    const name = byId("colour").value || "curvature";
    const shown = this.models.flatMap(({ recording }, k) => {
      const channel = recording.channels.get(name);
      const first = recording.firstShown(frames[k]); // what is in a sheath is straight
      const x = arcLength(recording.at("positions", frames[k])).subarray(first);
      return channel ? [{ channel, x, y: recording.at(name, frames[k]).subarray(first) }] : [];
    });
    if (!shown.length) return;
    const [{ channel }] = shown;
    const curves = shown.map(({ x, y }) => ({ y, x: channel.place === "sphere" ? x : middles(x) }));
    drawCurves(byId("along"), curves, say("arc length, units"), `${say(channel.label)}, ${channel.unit}`);
  }

  /** @param {string} which of the two */
  _drawOverTime(which) {
    const name = byId(which).value;
    const over = byId("over").value;
    const [axis, unitOver, times] = OVER[over];
    const drawn = this.models.filter(({ recording: { channels } }) => channels.has(name) && channels.has(over));
    if (!drawn.length) return;
    const { label, unit } = drawn[0].recording.channel(name);
    const curves = drawn.map(({ recording }) => ({ x: recording.overTime(over).map((value) => times * value), y: recording.overTime(name),
      band: recording.channels.get(`${name}Band`)?.values, isSudden: name.startsWith("hub") }));
    const cursor = times * drawn[0].recording.at(over, this._frames[this.models.indexOf(drawn[0])])[0];
    drawCurves(byId(`${which}Curve`), curves, `${say(axis)}, ${say(unitOver)}`, `${say(label)}, ${unit}`, cursor);
  }
}

/** Where spheres stand along the wire, units. @param {Float64Array} x */
function arcLength(x) {
  const along = new Float64Array(x.length / 3);
  for (let i = 1; i < along.length; i++) {
    const k = 3 * i;
    along[i] = along[i - 1] + Math.hypot(x[k] - x[k - 3], x[k + 1] - x[k - 2], x[k + 2] - x[k - 1]);
  }
  return along;
}

/** @param {Float64Array} x */
function middles(x) {
  return x.subarray(1).map((end, i) => 0.5 * (x[i] + end));
}

/** @param {HTMLSelectElement} select @param {string[][]} choices values and texts @param {number} chosen */
function fill(select, choices, chosen) {
  const before = select.value;
  select.replaceChildren(...choices.map(([value, text]) => make("option", { value }, text)));
  const kept = choices.findIndex(([value]) => value === before);
  select.selectedIndex = before && kept >= 0 ? kept : Math.min(chosen, choices.length - 1);
}
