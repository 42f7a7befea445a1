// @ts-check
/**
 * A run steered by the page whose worker this is, without a server: it does what guidewire/viewer/live.py does for pages of the
 * server, and its constants come from there, as rules.
 *
 * @typedef {import("./channels.js").State} State
 * @typedef {Record<string, any>} Message
 * @typedef {object} Program what simulates
 * @property {(request: Message) => Message} ask
 * @property {(motion: number[], steps: number) => Float64Array} step push (units) and turn (rad) of each hub in each of
 *     some steps: the head and all arrays
 * @property {() => Uint8Array} walls
 */
import { factsOf, largestShown, makeChannels, radiusOf, sheathOf } from "./channels.js";

const HEAD = 4; // numbers before the arrays of a step
const ARRAYS = /^(positions|orientations|catheter|lumen|contactForces|strandForces|wallDisplacements)\d+$|^(positions|velocities|orientations|angularVelocities|contactForces|strandForces|wallDisplacements|reaction|hub|lumen|vesselPhase|vesselDisplacement|vesselCentreline|strain|force|curvature|couple|energy)$/;
const NOT_ALLOWED = /^(?:.*: )?(\w+) = .* is not allowed: (needs .*)$/s;

/** What the program does not do. The message is one line. */
export class Refusal extends Error {}

export class Run {
  /** @param {Program} program @param {any} rules of guidewire/viewer/live.py @param {string[]} scenes
   * @param {number} opened scenes before, as the page counts @param {(message: any) => void} tell the page */
  constructor(program, rules, scenes, opened, tell) {
    this._program = program;
    this._rules = rules;
    this._scenes = scenes;
    this._opened = opened;
    this._tell = tell;
    /** Effective values; null while nothing is open. @type {Message | null} */
    this._parameters = null;
    /** @type {HeldInstruments | null} */
    this._held = null;
    /** As of the request "describe". @type {any} */
    this._described = null;
    /** @type {import("./recording.js").Wall[]} */
    this._walls = [];
    /** Largest size of each channel so far. @type {number[]} */
    this._largest = [];
    /** Names and counts of the state's arrays. @type {(readonly [string, number])[]} */
    this._layout = [];
    /** @type {State} */
    this._state = {};
    this._scene = "";
    this._isPaused = true;
    /** Whether it is paused until somebody steers. */
    this._isWaiting = false;
    this._isSteered = false;
    this._stepsAsked = 0;
    /** Push and turn from -1 to 1, of the held instrument, and of the next one. */
    this._hands = [[0, 0], [0, 0]];
    this._mark = this._cost = this._onTheWay = this._due = 0;
    this._pace = 1;
    this._problem = this._outcome = "";
    /** Why what was steered cannot be saved; empty where it can. */
    this._unrecorded = "";
    /** @type {Message} */
    this._named = {};
    /** Of instruments in this run, in words. @type {string[]} */
    this._exchanges = [];
    this._exchangesAsked = 0;
    this._isGoing = this._isAgent = false;
    /** The newest frame, where too many are on the way. @type {ArrayBuffer | null} */
    this._waiting = null;
    this._ports = new MessageChannel();
    this._ports.port1.onmessage = () => this._go();
  }

  /** Does what a page asks. @param {Message} message */
  hear(message) {
    if (message.do === "shown") {
      this._onTheWay = Math.max(0, this._onTheWay - 1);
      if (this._waiting) this._send(this._waiting);
      return;
    }
    try {
      this._do(message);
    } catch (error) {
      this._fail(error);
    }
    this._say();
    if (!this._isGoing && this._mayStep()) this._next(performance.now());
  }

  /** What was steered of each instrument, as drive tables. Throws where no table says it. */
  tables() {
    return this._program.ask({ session: "drive" }).tables;
  }

  /** @param {Message} message */
  _do(message) {
    switch (message.do) {
      case "hand":
        this._hands = [[message.push, message.turn], [message.otherPush ?? 0, message.otherTurn ?? 0]];
        this._mark = message.mark;
        if (this._hands.flat().some(Boolean)) this._beginAtLast();
        if (this._held && message.turn) this._held.aim = null;
        break;
      case "aim":
        if (this._held) this._held.aim = message.turn;
        this._beginAtLast();
        break;
      case "hold":
        this._held?.hold(message.instrument);
        break;
      case "inject":
        this._beginAtLast();
        this._tellAgent(this._program.ask({ session: "agent", amount: message.amount, rate: message.rate,
          ...(message.instrument === null ? { inlet: true } : { hub: message.instrument }) }));
        break;
      case "pause":
        [this._isPaused, this._isWaiting] = [message.value, false];
        break;
      case "step":
        [this._isPaused, this._isWaiting] = [true, false];
        this._stepsAsked = 1;
        break;
      case "pace":
        this._pace = message.value;
        break;
      case "open":
        this._open(message.scene, message.hand ?? true, {});
        break;
      case "name":
        this._open(this._scene, this._isSteered,
          { ...this._named, [this._described.instruments[message.instrument].key]: message.name });
        break;
      case "exchange":
        this._exchange(message.instrument, message.name);
        break;
      case "reset":
        this._begin(this._program.ask({ session: "reset" }), this._held?.held ?? 0);
        break;
      case "set":
        this._set(message.key, message.value);
    }
  }

  /** The first push: time runs from here on, unless somebody has paused. */
  _beginAtLast() {
    if (this._isWaiting) this._isWaiting = this._isPaused = false;
  }

  /** @param {string} scene @param {boolean} byHand @param {Message} named */
  _open(scene, byHand, named) {
    const open = (/** @type {boolean} */ hand) => this._program.ask({ session: "open", parameters: scene, hand, record: true,
      set: { ...(hand ? this._rules.endless : {}), ...named } });
    let answer;
    try {
      answer = open(byHand);
    } catch (error) {
      if (!byHand) throw error;
      answer = open(false); // what is wrong with the file itself is said here
    }
    this._parameters = answer.effective;
    this._isSteered = answer.hand;
    this._warnings = answer.warnings;
    [this._scene, this._named, this._cost] = [scene, named, 0];
    if (!this._scenes.includes(scene)) this._scenes.push(scene);
    this._described = this._program.ask({ session: "describe" });
    this._walls = this._readWalls();
    this._sheath = sheathOf(answer.effective, arraysOf(answer));
    this._begin(answer, 0);
  }

  /** The run is at its start. @param {Message} answer @param {number} held */
  _begin(answer, held) {
    this._problem = "";
    this._isAgent = false;
    [this._isPaused, this._isWaiting] = [true, this._isSteered]; // nothing is lost while somebody reads
    this._held = new HeldInstruments(this._described.instruments, held);
    this._exchanges = [];
    this._largest = [];
    this._present(answer);
  }

  /** Puts another instrument in the place of a withdrawn one, and the run goes on. @param {number} number
   * @param {string} name of the new one */
  _exchange(number, name) {
    const { key, title } = this._described.instruments[number];
    this._problem = "";
    this._exchangesAsked++;
    try {
      const answer = this._program.ask({ session: "exchange", hub: number, set: { [key]: name } });
      this._parameters = answer.effective;
      this._named = { ...this._named, [key]: name };
      this._described = this._program.ask({ session: "describe" });
      this._held?.exchange(this._described.instruments);
      this._exchanges.push(`at ${answer.time.toFixed(1)} s ${name} in place of ${title}`);
      this._cost = 0;
      this._present(answer);
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      this._problem = error.message; // nothing has changed
    }
  }

  /** The recording begins with this state. @param {Message} answer */
  _present(answer) {
    const channels = this._take(answer);
    this._largest = largestShown(channels).map((value, k) => Math.max(value, this._largest[k] ?? 0));
    channels.forEach((channel, k) => { channel.largest = this._largest[k]; });
    this._opened++;
    this._onTheWay = 0;
    this._waiting = null;
    this._tell({ opened: this._opened, recording: {
      title: this._titleOf(this._scene), outcome: "", warnings: this._warnings, facts: factsOf(this._parameters ?? {}),
      radius: radiusOf(this._parameters ?? {}), channels, walls: this._walls, sheath: this._sheath,
      described: this._described } });
  }

  /** @param {string} key @param {number | string} value */
  _set(key, value) {
    this._problem = "";
    try {
      const answer = this._program.ask({ session: "change", set: { [key]: value } });
      this._parameters = answer.effective;
      this._take(answer);
      this._cost = 0;
    } catch (error) {
      if (!(error instanceof Refusal)) throw error;
      const [, named, needs] = NOT_ALLOWED.exec(error.message) ?? [];
      const asked = `${key} = ${JSON.stringify(value)}`;
      this._problem = !named ? error.message.replace(/^command line: /, "")
        : named === key ? `${asked} is not allowed: ${needs}` : `${asked} does not go with ${named}, which ${needs}`;
    }
  }

  /** Says where contrast agent is. @param {Message} answer */
  _tellAgent({ agent, injected, held, isActive, isInjecting }) {
    this._isAgent = isActive;
    this._tell({ agent: { parts: agent, injected, held, isActive, isInjecting } });
  }

  _mayStep() {
    return this._parameters !== null && !this._outcome && (!this._isPaused || this._stepsAsked > 0);
  }

  /** Steps once more, when that is due; what the page has asked meanwhile comes first. @param {number} due */
  _next(due) {
    this._isGoing = true;
    this._due = due;
    const wait = due - performance.now();
    if (wait > 1) setTimeout(() => this._go(), wait);
    else this._ports.port2.postMessage(0);
  }

  _go() {
    this._isGoing = false;
    if (!this._mayStep()) return;
    try {
      this._stepOn();
    } catch (error) {
      this._fail(error);
      this._say();
    }
  }

  _stepOn() {
    const { frame, longest, pushSpeed, turnSpeed, smoothing, behind, longestWait } = this._rules;
    const dt = this._parameters?.timeStep;
    let steps = this._stepsAsked ? 1 : Math.max(1, Math.round(frame / dt));
    if (this._cost > 0) steps = Math.max(1, Math.min(steps, Math.trunc(longest / this._cost)));
    steps = 2 ** Math.floor(Math.log2(steps)); // parts of push and turn by a power of two are exact
    this._stepsAsked = Math.max(0, this._stepsAsked - steps);
    const held = /** @type {HeldInstruments} */ (this._held);
    const [hand, other] = this._hands.map(([push, turn]) => [pushSpeed * push * dt, turnSpeed * turn * dt]);
    hand[1] += held.towardsAim(this._state, steps, turnSpeed * dt);
    const moves = this._isSteered ? held.motion(hand, other) : [[0, 0]];
    const began = performance.now();
    const numbers = this._program.step(moves.flat(), steps);
    const cost = (performance.now() - began) / 1000 / steps;
    this._cost = this._cost === 0 ? cost : this._cost + smoothing * (cost - this._cost);
    const size = this._layout.reduce((sum, [, count]) => sum + count, HEAD);
    const channels = numbers[2] || numbers.length !== size ? this._take(this._program.ask({ session: "state" }))
      : this._channels(numbers[0], numbers[1], split(this._layout, numbers));
    if (this._isAgent) this._tellAgent(this._program.ask({ session: "agent" }));
    this._largest = largestShown(channels).map((value, k) => Math.max(value, this._largest[k] ?? 0));
    const values = channels.flatMap((channel) => [...channel.values]);
    this._send(Float64Array.from([this._mark, this._opened, ...this._largest, ...values]).buffer);
    if (this._outcome) {
      this._isPaused = true;
      this._say();
    }
    const now = performance.now();
    this._next(Math.min(Math.max(this._due + (1000 * steps * dt) / this._pace, now - 1000 * behind),
      now + 1000 * longestWait));
  }

  /** Sends a frame, or the newest of several when the page has shown others. @param {ArrayBuffer} frame */
  _send(frame) {
    const isSent = this._onTheWay < this._rules.mostInFlight;
    this._waiting = isSent ? null : frame;
    if (!isSent) return;
    this._onTheWay++;
    this._tell({ frame });
  }

  /** The state of an answer. @param {Message} answer */
  _take(answer) {
    this._unrecorded = answer.unrecorded ?? this._unrecorded;
    const state = arraysOf(answer);
    this._layout = Object.entries(state).map(([name, { length }]) => /** @type {const} */ ([name, length]));
    const trust = answer.reliable ? "reliable" : "not reliable";
    this._outcome = answer.outcome ? `${answer.outcome}, ${trust}: ${answer.message}` : "";
    return this._channels(answer.step, answer.time, state);
  }

  /** @param {number} step @param {number} time @param {State} state */
  _channels(step, time, state) {
    this._state = { ...state, step: Float64Array.of(step), time: Float64Array.of(time) };
    const rate = this._cost > 0 ? this._parameters?.timeStep / this._cost : NaN;
    return makeChannels(this._rules, this._parameters ?? {}, this._state, this._walls.length > 0,
      [1000 * this._cost, rate]);
  }

  _readWalls() {
    const bytes = this._program.walls();
    const view = new DataView(bytes.buffer, bytes.byteOffset);
    const walls = [];
    const { vessel, obstacles } = this._parameters ?? {};
    const own = [vessel, ...(obstacles ?? [])].filter(Boolean);
    for (let at = 0; at < bytes.length;) {
      const [corners, sides] = [3 * view.getInt32(at, true), 3 * view.getInt32(at + 4, true)];
      const part = (/** @type {number} */ from, /** @type {number} */ to) => bytes.slice(at + from, at + to).buffer;
      walls.push({ kind: walls.length === 0 && this._parameters?.vessel ? "vessel" : "obstacle",
        isSoft: ["wallStiffness", "modulus"].some((key) => key in (own[walls.length] ?? {})),
        vertices: Float32Array.from(new Float64Array(part(8, 8 + 8 * corners))),
        triangles: new Uint32Array(part(8 + 8 * corners, 8 + 8 * corners + 4 * sides)) });
      at += 8 + 8 * corners + 4 * sides;
    }
    return walls;
  }

  /** Says what could not be done. After what is no refusal there is no program any more. @param {any} error */
  _fail(error) {
    this._problem = error instanceof Refusal ? error.message : `the simulation has ended unexpectedly: ${error.message}`;
    this._isPaused = true;
    if (!(error instanceof Refusal)) this._parameters = null;
  }

  /** @param {string} scene */
  _titleOf(scene) {
    return this._rules.titles?.[scene] ?? scene.replace(/^.*\//, "").replace(/\.json$/, "").replaceAll("-", " ");
  }

  _say() {
    const { changed, choices, paces } = this._rules;
    const parameters = this._parameters ?? {};
    const valueAt = (/** @type {string} */ key) => key.split(".").reduce((/** @type {any} */ part, name) => part?.[name], parameters);
    const values = Object.fromEntries(changed.filter((/** @type {string} */ key) => valueAt(key) !== undefined)
      .map((/** @type {string} */ key) => [key, valueAt(key)]));
    this._tell({ status: {
      hand: true, isFree: false, isPaused: this._isPaused, isWaiting: this._isWaiting, isSteered: this._isSteered, opened: this._opened,
      scene: this._scene, scenes: this._scenes, titles: this._scenes.map((scene) => this._titleOf(scene)),
      file: this._scene, problem: this._problem, values,
      choices: Object.fromEntries(Object.entries(choices).filter(([key]) => key in values)),
      exchanges: this._exchanges, exchangesAsked: this._exchangesAsked, pace: this._pace, paces, outcome: this._outcome,
      ...(this._held?.status() ?? { held: 0, instruments: [], chosen: [], named: [] }),
      steered: this._held ? this._unrecorded : "no run is open",
    } });
  }
}

/** The wire and the catheters of a run; one of their hubs is held at a time. */
export class HeldInstruments {
  /** @param {{title: string, name: string, key: string, choices: string[]}[]} instruments as described
   * @param {number} held */
  constructor(instruments, held) {
    this._instruments = instruments;
    this.held = held;
    /** Turn that the held hub goes to, rad; null: it turns as the hand does. @type {number | null} */
    this.aim = null;
  }

  /** Another instrument is in the place of one, and the run goes on. @param {HeldInstruments["_instruments"]} instruments */
  exchange(instruments) {
    this.aim = null;
    this._instruments = instruments;
  }

  /** Takes another one. @param {number} number */
  hold(number) {
    this.held = number;
    this.aim = null;
  }

  /** Turn in each of some steps that brings the held hub to its aim, rad. @param {State} state @param {number} steps
   * @param {number} most its size */
  towardsAim(state, steps, most) {
    const hub = this.held === 0 ? state.hub : state[`catheter${this.held}`];
    return this.aim === null || !hub ? 0 : Math.min(Math.max((this.aim - hub[1]) / steps, -most), most);
  }

  /** What both hands ask of each hub: one of the held, the other of the next one. @param {number[]} hand
   * @param {number[]} other */
  motion(hand, other) {
    const next = (this.held + 1) % this._instruments.length;
    return this._instruments.map((_, k) => (k === this.held ? hand : k === next ? other : [0, 0]));
  }

  /** What a page shows of the instruments. */
  status() {
    return { held: this.held, instruments: this._instruments.map(({ title }) => title),
      chosen: this._instruments.map(({ name }) => name),
      named: this._instruments.map(({ choices }) => choices).filter(({ length }) => length) };
  }
}

/** @param {Message} answer @returns {State} */
function arraysOf(answer) {
  return Object.fromEntries(Object.entries(answer).filter(([name]) => ARRAYS.test(name)).map(([name, text]) =>
    [name, new Float64Array(Uint8Array.from(atob(text), (one) => one.charCodeAt(0)).buffer)]));
}

/** @param {(readonly [string, number])[]} layout @param {Float64Array} numbers @returns {State} */
function split(layout, numbers) {
  let at = HEAD;
  return Object.fromEntries(layout.map(([name, count]) => [name, numbers.subarray(at, at += count)]));
}
