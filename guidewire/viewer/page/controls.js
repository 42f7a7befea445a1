// @ts-check
import { byId, make, menu, named } from "./panel.js";
import { whileHeld } from "./steering.js";
import { say } from "./words.js";

/** @typedef {import("./live.js").Status} Status */

/** The buttons below the pictures, and the fields of the simulation. */
export class Controls {
  /** @param {import("./live.js").Live} live */
  constructor(live) {
    this._live = live;
    /** Whether a value was sent that has no answer yet. */
    this._isSent = false;
    /** What the buttons were made of. */
    this._shown = "";
  }

  /** @param {Status} status */
  make(status) {
    const { isFine } = this._live.steering;
    const shown = JSON.stringify([status, isFine, this._live.injector.isUseful]);
    if (shown !== this._shown) this._fill(status);
    this._shown = shown;
    const typed = byId("controls").contains(document.activeElement) ? document.activeElement : null;
    if (typed && !this._isSent) return; // a value that is being typed
    this._isSent = false;
    byId("controls").replaceChildren(...(status.hand ? [...this._names(status), ...this._values(status)] : []));
  }

  /** The buttons anew; the one that a keyboard has reached stays reached, and what is open stays open.
   * @param {Status} status */
  _fill(status) {
    const bar = byId("bar");
    const all = () => [...bar.querySelectorAll("button, select, input, summary")];
    const [reached, isOpen] = [all().indexOf(document.activeElement), byId("rest")?.open];
    bar.replaceChildren(...(status.hand ? this._bar(status)
      : status.isFree ? [this._button("take control", { do: "take" })]
      : [make("span", {}, "another page is steering; when it is closed you can take over")]));
    if (isOpen && byId("rest")) byId("rest").open = true;
    if (reached >= 0) all()[reached]?.focus();
  }

  /** @param {string} text @param {object} message */
  _button(text, message) {
    return make("button", { onclick: () => this._live.send(message) }, text);
  }

  /** In three ranks: what steers, what is used often, and the rest. @param {Status} status */
  _bar(status) {
    const live = this._live;
    const isOver = status.outcome !== "" || live.isGone(status);
    const drive = status.isSteered ? "watch the recorded drive" : "steer by hand";
    const saving = make("button", { id: "save", onclick: () => live.saveSteering(), disabled: status.steered !== "",
      title: status.steered || "the table repeats the motion: key driveFile" }, "save steering");
    const often = status.isSteered && !isOver;
    const group = (/** @type {any[]} */ ...children) => make("span", { className: "group" }, ...children);
    return [
      ...(status.isSteered ? [this._pads(), ...this._drives()] : []),
      group(...(status.isSteered && status.instruments.length > 1 ? [this._hold(status)] : []),
        ...(often ? [live.injector.button, ...(live.injector.isUseful ? []
          : [make("span", { className: "why" }, "no centreline, no blood flow")])] : []),
        ...(isOver ? [] : [this._pause(status)]), ...(often ? [this._fine()] : []),
        menu("rest", "more buttons", make("button", { onclick: () => live.restart() }, "start anew"),
          make("button", { id: "reporting", onclick: () => live.report() }, "report"),
          ...(isOver ? [] : [this._button("step", { do: "step" })]),
          ...(live.canExchange && !isOver ? [this._exchange()] : []), saving,
          make("button", { onclick: () => live.leave(drive, () =>
            live.send({ do: "open", scene: status.scene, hand: !status.isSteered })) }, drive),
          make("button", { className: "phone", onclick: () => document.body.classList.toggle("more") }, "forces and settings"),
          this._slider(status.isPaused && live.frames.newest > 0), this._paces(status), this._cases(status))),
    ];
  }

  /** For two thumbs, or two fingers. */
  _pads() {
    const pad = (/** @type {string} */ id, /** @type {string} */ name, /** @type {string[]} */ [low, high], /** @type {number} */ axis) => {
      const made = named("div", name, { id, className: "pad" }, make("span", { className: "low" }, low),
        make("span", { className: "high" }, high));
      made.setAttribute("role", "application");
      this._live.steering.listen(made, axis);
      return made;
    };
    return make("div", { className: "pads" }, pad("slide", "push pad: up pushes, down pulls", ["push ↑", "pull ↓"], 0),
      pad("spin", "turn pad: sideways turns", ["↺ turn", "turn ↻"], 1));
  }

  _drives() {
    const { steering } = this._live;
    const held = (/** @type {string} */ text, /** @type {string} */ key) => make("button", { className: key === "w" ? "drive on" : "drive",
      ...whileHeld(() => steering.hold(key), () => steering.release()) }, text, " ", make("kbd", {}, key.toUpperCase()));
    return [[["push", "w"], ["pull", "s"]], [["turn left", "a"], ["turn right", "d"]]].map((pair) =>
      make("span", { className: "group" }, ...pair.map(([text, key]) => held(text, key))));
  }

  _fine() {
    const fine = make("button", { id: "fine", onclick: () => this._live.refine(), title: "a fifth of the speed" }, "fine ",
      make("kbd", {}, "G"));
    fine.setAttribute("aria-pressed", String(this._live.steering.isFine));
    return fine;
  }

  /** @param {Status} status */
  _hold(status) {
    return make("button", { id: "hold", onclick: () => this._live.holdNext(), title: "the steered instrument" },
      status.instruments[status.held] ?? "", " ", make("kbd", {}, "I"));
  }

  _exchange() {
    return make("button", { id: "exchange", onclick: () => this._live.exchange(), title: "another instrument over the wire" },
      "exchange ", make("kbd", {}, "Q"));
  }

  /** @param {Status} status */
  _pause(status) {
    const text = status.isWaiting ? "begin" : status.isPaused ? "go on" : "pause";
    return Object.assign(this._button(text, { do: "pause", value: !status.isPaused }), { id: "pause" });
  }

  /** It keeps its place while it can do nothing. @param {boolean} isUseful */
  _slider(isUseful) {
    const { newest, shown } = this._live.frames;
    const back = named("input", "look back", { type: "range", id: "back", min: 0, step: 1, max: newest, value: shown,
      oninput: () => this._live.lookBack(Number(back.value)) });
    back.style.visibility = isUseful ? "visible" : "hidden";
    return back;
  }

  /** @param {Status} status */
  _paces(status) {
    const paces = named("select", "speed", { id: "pace",
      onchange: () => this._live.send({ do: "pace", value: Number(paces.value) }) },
    ...status.paces.map((pace) =>
      make("option", { value: pace, selected: pace === status.pace }, say("{0} x real time", pace))));
    return paces;
  }

  /** @param {Status} status */
  _cases(status) {
    const cases = named("select", "case", { id: "scenes", onchange: () => this._live.leave(
      say("open {0}", cases.selectedOptions[0].textContent), () => this._live.send({ do: "open", scene: cases.value }),
      () => { cases.value = status.scene; }) },
    ...status.scenes.map((scene, k) =>
      make("option", { value: scene, selected: scene === status.scene }, status.titles[k])));
    return cases;
  }

  /** @param {Status} status */
  _names(status) {
    return status.named.map((names, k) => {
      const select = make("select", { onchange: () => this._live.leave(say("begin anew with {0}", select.value),
        () => this._live.send({ do: "name", instrument: k, name: select.value }), () => { select.value = status.chosen[k]; }) },
      ...[...(status.chosen[k] ? [] : [""]), ...names].map((name) =>
        make("option", { value: name, selected: name === status.chosen[k], disabled: name === "" }, name)));
      return make("label", {}, say(k === 0 ? "instrument" : "catheter"), status.named.length > 2 && k ? ` ${k}` : "", select);
    });
  }

  /** @param {Status} status */
  _values(status) {
    return Object.entries(status.values).map(([key, value]) => {
      const set = () => {
        this._isSent = true; // the answer puts what is in force into the field, also where the value is refused
        this._live.send({ do: "set", key, value: key in status.choices ? input.value : Number(input.value) });
      };
      const input = key in status.choices
        ? make("select", { onchange: set }, ...status.choices[key].map((word) =>
          make("option", { value: word, selected: word === value }, word)))
        : make("input", { type: "number", step: "any", value, onchange: set });
      return make("label", {}, key, input);
    });
  }
}
