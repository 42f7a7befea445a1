// @ts-check
import { byId, make } from "./panel.js";
import { whileHeld } from "./steering.js";

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

  /** The buttons anew; the one that a keyboard has reached stays reached. @param {Status} status */
  _fill(status) {
    const reached = [...byId("bar").querySelectorAll("button, select, input")].indexOf(document.activeElement);
    byId("bar").replaceChildren(...(status.hand ? this._bar(status)
      : status.isFree ? [this._button("take control", { do: "take" })]
      : [make("span", {}, "another page is steering; when it is closed you can take over")]));
    if (reached >= 0) byId("bar").querySelectorAll("button, select, input")[reached]?.focus();
  }

  /** @param {string} text @param {object} message */
  _button(text, message) {
    return make("button", { onclick: () => this._live.send(message) }, text);
  }

  /** @param {Status} status */
  _bar(status) {
    const live = this._live;
    const isOver = status.outcome !== "" || live.isGone(status);
    const drive = status.isSteered ? "watch the recorded drive" : "steer by hand";
    const more = make("button", { id: "more", onclick: () => byId("bar").classList.toggle("open") }, "more");
    more.setAttribute("aria-label", "more buttons");
    const saving = make("button", { id: "save", className: "second", onclick: () => live.saveSteering(), title: status.steered
      || "the table repeats the motion: key driveFile" }, "save steering");
    saving.disabled = status.steered !== "";
    const second = (/** @type {any} */ button) => {
      button.classList.add("second");
      return button;
    };
    return [
      ...(status.isSteered ? [this._pad(), ...this._drives(),
        ...(status.instruments.length > 1 ? [this._hold(status)] : []),] : []),
      make("span", { className: "buttons" },
        ...(status.isSteered && !isOver ? [live.injector.button,
          ...(live.injector.isUseful ? [] : [make("span", { className: "why" }, "no centreline, no blood flow")]), this._fine()] : []),
        ...(live.canExchange && !isOver ? [this._exchange()] : []), ...(isOver ? [] : [this._pause(status),
          second(this._button("step", { do: "step" }))]),
        make("button", { onclick: () => live.restart() }, "start anew"),
        make("button", { id: "reporting", onclick: () => live.report() }, "report"),
        this._slider(status.isPaused && live.frames.newest > 0), saving,
        make("button", { className: "second", onclick: () => live.leave(drive, () =>
          live.send({ do: "open", scene: status.scene, hand: !status.isSteered })) }, drive),
        this._paces(status), this._cases(status), more),
    ];
  }

  _pad() {
    const label = (/** @type {string} */ side, /** @type {string} */ text) => make("span", { className: side }, text);
    const pad = make("div", { id: "pad" }, label("up", "push"), label("left", "turn left"), label("right", "turn right"),
      label("down", "pull"));
    pad.setAttribute("role", "application");
    pad.setAttribute("aria-label", "touch: up pushes, down pulls, sideways turns");
    this._live.steering.listen(pad);
    return pad;
  }

  _drives() {
    const { steering } = this._live;
    const held = (/** @type {string} */ text, /** @type {string} */ key, /** @type {string} */ cap) =>
      make("button", { className: "drive", ...whileHeld(() => steering.hold(key), () => steering.release()) }, text, " ", make("kbd", {}, cap));
    return [held("push", "w", "W"), held("pull", "s", "S"), held("turn left", "a", "A"), held("turn right", "d", "D")];
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
    return make("button", { id: "exchange", className: "second", onclick: () => this._live.exchange(),
      title: "another instrument over the wire" }, "exchange ", make("kbd", {}, "Q"));
  }

  /** @param {Status} status */
  _pause(status) {
    const text = status.isWaiting ? "begin" : status.isPaused ? "go on" : "pause";
    const made = this._button(text, { do: "pause", value: !status.isPaused });
    made.id = "pause";
    return made;
  }

  /** It keeps its place while it can do nothing. @param {boolean} isUseful */
  _slider(isUseful) {
    const { newest, shown } = this._live.frames;
    const back = make("input", { type: "range", id: "back", min: 0, step: 1, max: newest, value: shown,
      oninput: () => this._live.lookBack(Number(back.value)) });
    back.setAttribute("aria-label", "look back");
    back.style.visibility = isUseful ? "visible" : "hidden";
    return back;
  }

  /** @param {Status} status */
  _paces(status) {
    const paces = make("select", { id: "pace", className: "second",
      onchange: () => this._live.send({ do: "pace", value: Number(paces.value) }) },
    ...status.paces.map((pace) =>
      make("option", { value: pace, selected: pace === status.pace }, `${pace} x real time`)));
    paces.setAttribute("aria-label", "speed");
    return paces;
  }

  /** @param {Status} status */
  _cases(status) {
    const cases = make("select", { id: "scenes", className: "second", onchange: () => this._live.leave(
      `open ${cases.selectedOptions[0].textContent}`, () => this._live.send({ do: "open", scene: cases.value }),
      () => { cases.value = status.scene; }) },
    ...status.scenes.map((scene, k) =>
      make("option", { value: scene, selected: scene === status.scene }, status.titles[k])));
    cases.setAttribute("aria-label", "case");
    return cases;
  }

  /** @param {Status} status */
  _names(status) {
    return status.named.map((names, k) => {
      const select = make("select", { onchange: () => this._live.leave(`begin anew with ${select.value}`,
        () => this._live.send({ do: "name", instrument: k, name: select.value }), () => { select.value = status.chosen[k]; }) },
      ...[...(status.chosen[k] ? [] : [""]), ...names].map((name) =>
        make("option", { value: name, selected: name === status.chosen[k], disabled: name === "" }, name)));
      return make("label", {}, k === 0 ? "instrument" : `catheter${status.named.length > 2 ? ` ${k}` : ""}`, select);
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
