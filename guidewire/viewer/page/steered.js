// @ts-check
/**
 * Steering that a drive table can repeat to the bit, as guidewire/sessions/steered.py and guidewire/viewer/held.py have
 * it: a test compares the two. Constants come from there, as rules.
 *
 * @typedef {{grain: number, turnGrain: number, constant: number, stopped: number, tries: number}} Rules
 * @typedef {Record<string, any>} Parameters effective values
 */

/** To the nearest whole number, of two the even one. @param {number} x */
function round(x) {
  const near = Math.round(x);
  return near - x === 0.5 && near % 2 !== 0 ? near - 1 : near;
}

/** The next double above or below. @param {number} x not 0 @param {boolean} isAbove */
function next(x, isAbove) {
  const bits = new BigInt64Array(new Float64Array([x]).buffer);
  bits[0] += (x > 0) === isAbove ? 1n : -1n;
  return new Float64Array(bits.buffer)[0];
}

/** A push in a step, units, near a wanted one, for which metres * push is a multiple of the grain.
 * @param {Rules} rules @param {number} wanted @param {number} metres */
export function exactPush(rules, wanted, metres) {
  const middle = round((metres * wanted) / rules.grain);
  for (let k = 0; k < rules.tries; k++) {
    const displacement = (middle + ((k + 1) >> 1) * (k % 2 ? 1 : -1)) * rules.grain;
    const push = displacement / metres;
    if (displacement === 0) return 0;
    for (const near of [push, next(push, true), next(push, false)]) {
      if (metres * near === displacement) return near;
    }
  }
  throw new Error(`no push near ${wanted} units gives an exact displacement`);
}

/** A turn in a step, rad, near a wanted one, that is a multiple of the grain. @param {Rules} rules
 * @param {number} wanted */
export function exactTurn(rules, wanted) {
  return round(wanted / rules.turnGrain) * rules.turnGrain;
}

/** What a hand has done with a hub since a run's start. */
export class Steered {
  /** @param {Rules} rules @param {Parameters} parameters */
  constructor(rules, parameters) {
    this._rules = rules;
    /** Why no table says what was steered; empty where one does. */
    this.problem = parameters.solver === "direct" && parameters.drive === "displace" ? ""
      : "only a wire of solver direct with drive \"displace\" takes a drive table";
    this._dt = parameters.timeStep;
    this._metres = parameters.metresPerUnit ?? 1e-3;
    /** Step, m, rad. */
    this._rows = [[0, 0, 0]];
    /** What other hubs have made of it by carrying it along, m. */
    this._carried = 0;
  }

  /**
   * Notes a call.
   * @param {number} push in each step, units @param {number} turn in each step, rad @param {number} step after it
   * @param {number | null} reached insertion after it, m, of a hub that meets others
   */
  add(push, turn, step, reached) {
    if (this.problem) return;
    let [before, insertion, rotation] = this._rows[this._rows.length - 1];
    const displacement = this._metres * push;
    const beyond = reached === null ? 0
      : reached - (insertion + this._carried + displacement * (step - before));
    const differs = Math.abs(beyond) > this._rules.stopped;
    const end = differs && beyond * displacement < 0 ? Number(reached) - this._carried : null;
    if (differs && end === null) this._carried += beyond;
    while (before < step) {
      insertion += displacement;
      if (end !== null) insertion = displacement > 0 ? Math.min(insertion, end) : Math.max(insertion, end);
      rotation += turn;
      this._rows.push([++before, insertion, rotation]);
    }
  }

  /** The table, as `driveFile` takes it. Around each multiple of dt it is constant. */
  toCsv() {
    const lines = ["time,insertion,rotation", "0.0,0.0,0.0"];
    for (const [step, insertion, rotation] of this._rows) {
      for (const side of step ? [-1, 1] : [1]) {
        lines.push(`${step * this._dt + side * this._rules.constant * this._dt},${insertion},${rotation}`);
      }
    }
    return `${lines.join("\n")}\n`;
  }
}

/** The wire and the catheters of a run; one of their hubs is held at a time. */
export class HeldInstruments {
  /**
   * @param {Rules} rules @param {Parameters} parameters @param {{title: string, name: string, key: string,
   *     choices: string[]}[]} instruments as described @param {boolean} hasHand @param {number} held
   */
  constructor(rules, parameters, instruments, hasHand, held) {
    this._rules = rules;
    this._parameters = parameters;
    this._instruments = instruments;
    this._hasHand = hasHand;
    this.held = held;
    /** Turn that the held hub goes to, rad; null: it turns as the hand does. @type {number | null} */
    this.aim = null;
    this.steered = instruments.map(() => new Steered(rules, parameters));
  }

  /** Another instrument is in the place of one, and the run goes on. @param {HeldInstruments["_instruments"]} instruments
   * @param {Parameters} parameters */
  exchange(instruments, parameters) {
    this.aim = null;
    this._instruments = instruments;
    this._parameters = parameters;
    this.invalidate("an instrument was exchanged within the run: start anew to record");
  }

  /** Takes another one. @param {number} number */
  hold(number) {
    this.held = number;
    this.aim = null;
  }

  /** Turn in each of some steps that brings the held hub to its aim, rad. @param {import("./channels.js").State} state
   * @param {number} steps @param {number} most its size */
  towardsAim(state, steps, most) {
    const hub = this.held === 0 ? state.hub : state[`catheter${this.held}`];
    return this.aim === null || !hub ? 0 : Math.min(Math.max((this.aim - hub[1]) / steps, -most), most);
  }

  /** What is asked of the held hub in a step, units and rad. @param {number} push @param {number} turn */
  inAStep(push, turn) {
    if (!this._hasHand) return [0, 0];
    const metres = this._parameters.metresPerUnit;
    return [metres === undefined ? push : exactPush(this._rules, push, metres), exactTurn(this._rules, turn)];
  }

  /** Notes a call. @param {number} push @param {number} turn in each step @param {number} step after it
   * @param {import("./channels.js").State} state */
  add(push, turn, step, state) {
    this.addAll(this.steered.map((_, k) => (k === this.held ? [push, turn] : [0, 0])), step, state);
  }

  /** Which instrument the other hand holds: the one after the held; -1 where there is one alone. */
  get second() {
    return this._instruments.length > 1 ? (this.held + 1) % this._instruments.length : -1;
  }

  /** What is asked of each hub in a step, units and rad, by both hands. @param {number[]} hand @param {number[]} other */
  moves(hand, other) {
    return this._instruments.map((_, k) => (k === this.held ? this.inAStep(hand[0], hand[1])
      : k === this.second ? this.inAStep(other[0], other[1]) : [0, 0]));
  }

  /** Notes a call of all hubs. @param {number[][]} moves push and turn of each in each step @param {number} step after it
   * @param {import("./channels.js").State} state */
  addAll(moves, step, state) {
    const catheters = this._parameters.catheters ?? [];
    this.steered.forEach((one, k) => {
      const own = k === 0 ? this._parameters : catheters[k - 1];
      const isFree = !catheters.length || (own.hubForceLimit && own.hubForceLimit !== "hand");
      const reached = isFree ? null : (k === 0 ? state.hub : state[`catheter${k}`])[0];
      one.add(moves[k][0], moves[k][1], step, reached);
    });
  }

  /** From here on no table says what was steered. @param {string} why */
  invalidate(why) {
    for (const one of this.steered) one.problem ||= why;
  }

  /** What a page shows of the instruments. */
  status() {
    return { held: this.held, instruments: this._instruments.map(({ title }) => title),
      chosen: this._instruments.map(({ name }) => name),
      named: this._instruments.map(({ choices }) => choices).filter(({ length }) => length),
      steered: this.steered[0].problem };
  }
}
