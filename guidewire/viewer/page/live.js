// @ts-check
import { Coach } from "./coach.js";
import { brief } from "./colours.js";
import { Controls } from "./controls.js";
import { ask } from "./dialog.js";
import { Injector } from "./injector.js";
import { bestOf, judge, keepBest } from "./missions.js";
import { Model } from "./model.js";
import { byId, make, named } from "./panel.js";
import { Recording } from "./recording.js";
import { courseOf, Debrief, rowsOf, save, thinned } from "./report.js";
import { hum } from "./sounds.js";
import { Steering } from "./steering.js";
import { placeName } from "./target.js";
import { fixed, say } from "./words.js";

/**
 * What is said of the run, as guidewire/viewer/live.py or run.js sends it.
 * @typedef {object} Status
 * @property {boolean} hand whether this page has the run in its hand
 * @property {boolean} isFree whether no page has
 * @property {boolean} isSteered whether push and turn do something
 * @property {boolean} isPaused
 * @property {boolean} isWaiting paused until somebody steers
 * @property {number} opened how often a run was opened: another number, another recording
 * @property {number} pace of in-game time against the clock
 * @property {number[]} paces
 * @property {string} scene
 * @property {string[]} scenes
 * @property {string[]} titles of them, as cases
 * @property {string} file of the scene, as `run` takes it
 * @property {string} outcome empty while the run goes on
 * @property {string} problem empty where there is none
 * @property {string} steered why what was steered cannot be saved; empty where it can
 * @property {Record<string, number | string>} values the parameters that may be changed
 * @property {Record<string, string[]>} choices of those that are words
 * @property {string[]} instruments the wire, and the catheters over it
 * @property {number} held which of them the hand holds
 * @property {string[][]} named for each the names that can stand for it; empty where the method takes none
 * @property {string[]} exchanges of instruments in this run, in words
 * @property {number} exchangesAsked how many were asked for, done or refused
 * @property {string[]} chosen the name that each has; empty where it has none
 */

const REMINDED = 2500; // ms
const SLOW = 0.9; // of the chosen speed
const LOSS = 10; // s of a run that are not lost without a question

/** A run that goes on in the runner. Here are only keys and pictures. */
export class Live {
  /**
   * @param {import("./stage.js").Stage} stage @param {import("./panel.js").Panel} panel
   * @param {import("./desk.js").Desk} desk @param {import("./xray.js").Xray} xray
   * @param {import("./connection.js").Connection} connection
   */
  constructor(stage, panel, desk, xray, connection) {
    this._stage = stage;
    this._panel = panel;
    this._desk = desk;
    desk.isLive = true;
    this._xray = xray;
    /** @type {Model | null} */
    this.model = null;
    /** @type {Status | null} */
    this.status = null;
    /** Frames that have come. */
    this.received = 0;
    /** Number of the scene whose recording is shown, as the server counts. */
    this._opened = 0;
    /** Frames that came before the recording of their scene, each after its two numbers. @type {Float64Array[]} */
    this._early = [];
    /** Times from a key to the picture that shows what it did, ms. @type {number[]} */
    this.delays = [];
    this.steering = new Steering((...hands) => this._tell(...hands), (button) => this._press(button));
    desk.onDial = (turn) => this._aim(turn);
    /** The frame that is looked back at; null: the newest. @type {number | null} */
    this._back = null;
    this.injector = new Injector((message) => this.send(message));
    this._controls = new Controls(this);
    this._coach = new Coach(xray);
    this._debrief = new Debrief((frame) => this.lookBack(frame));
    /** What is to be achieved. @type {(import("./missions.js").Mission & {file: string}) | null} */
    this.mission = null;
    /** Told where a scene is shown. @type {(scene: string) => void} */
    this.onOpened = () => {};
    /** Told what could not be done. @type {(problem: string) => void} */
    this.onProblem = () => {};
    this._steeredAt = -REMINDED; // ms: when a hand last moved a paused wire
    this._isReported = false;
    /** Whose wire is shown beside one's own, with the report. @type {import("./report.js").Course | null} */
    this._ghost = null;
    this._exchanged = 0; // how many of the run are shown
    this._exchangesAsked = Infinity; // as of the status that answers an exchange
    this._mark = 0;
    this._marks = new Map();
    this._newest = 0;
    stage.onDrawn = xray.onDrawn = () => this._shown();
    this._connection = connection;
    connection.onmessage = (message) => (message instanceof ArrayBuffer ? this._take(message)
      : "agent" in message ? xray.fill(this.injector.take(message.agent)) : this._hear(message));
    connection.onclose = (reason) => {
      panel.say([reason]);
      this.onProblem(reason);
    };
    document.addEventListener("visibilitychange", () => document.hidden && !this.status?.isPaused && this.pause(true));
    addEventListener("keyup", ({ key }) => ["e", "enter"].includes(key.toLowerCase()) && this.injector.release());
    addEventListener("blur", () => this.injector.release());
    addEventListener("pagehide", () => this._keep());
  }

  /** @param {Record<string, any>} message */
  send(message) {
    this._connection.send(message);
  }

  /** @param {string} button of a gamepad */
  _press(button) {
    const card = byId("card");
    if (!byId("start").hidden) pressGallery(button);
    else if (card.open || "debrief" in document.body.dataset) pressCard(card.open ? card : byId("debrief"), button);
    else if (button === "exchange") this.exchange();
    else if (button === "pause") this.pause(!this.status?.isPaused);
    else if (button === "reset") this.restart();
    else if (button === "hold") this.holdNext();
    else if (button === "fine") this.refine();
    else if (button === "beam") this._xray.beam.set(!this._xray.beam.isOn);
    else {
      this.injector.press();
      this.injector.release();
    }
  }

  /** Steers finely, or no longer. */
  refine() {
    this.steering.refine(!this.steering.isFine);
    byId("fine")?.setAttribute("aria-pressed", String(this.steering.isFine));
  }

  /** @param {KeyboardEvent} event @returns {boolean} whether the key means something here */
  key(event) {
    if (this.steering.key(event)) return true;
    if (event.key === " ") this.pause(!this.status?.isPaused);
    else if (event.key === "g") this.refine();
    else if (event.key === "e") this.injector.press();
    else if (event.key === "n") this.send({ do: "step" });
    else if (event.key === "i") this.holdNext();
    else if (event.key === "q") this.exchange();
    else if (event.key === "r") this.restart();
    else return false;
    return true;
  }

  /** @param {boolean} isPaused */
  pause(isPaused) {
    this.send({ do: "pause", value: isPaused });
  }

  /** s of the run so far. */
  get _time() {
    return this.model?.recording.at("time", this.model.recording.count - 1)[0] ?? 0;
  }

  /** Asks before a run that has begun is lost. @param {string} what takes its place @param {() => void} go opens it
   * @param {() => void} stay called where it does not */
  async leave(what, go, stay = () => {}) {
    if (this._time === 0 || await this._mayLose(say(what), "leave", "stay")) go();
    else stay();
  }

  /** Begins the run anew; asks where much of it would be lost. */
  async restart() {
    const isGone = !this.status || this.status.outcome || this.isGone(this.status);
    if (isGone || this._time <= LOSS || await this._mayLose(say("start anew"), "start anew", "go on")) this.send({ do: "reset" });
  }

  /** Whether the run may end; it stands while one reads. @param {string} what @param {string} yes @param {string} no */
  async _mayLose(what, yes, no) {
    this.steering.release();
    const isGoing = this.status && !this.status.isPaused;
    if (isGoing) this.pause(true);
    const answer = await ask(`${what}?`, [make("p", {},
      say("The run of {0} s ends with it. Steering and report can be saved before.", fixed(this._time, 1)))], [yes, no]);
    if (answer !== yes && isGoing) this.pause(false);
    return answer === yes;
  }

  /** Nothing is simulated any more. */
  forget() {
    [this.model, this.status, this._shownScene] = [null, null, undefined];
  }

  /** What the score knows, for a page that is loaded anew. */
  _keep() {
    if (this._desk.score && this.status) {
      sessionStorage.setItem(location.pathname, JSON.stringify({ opened: this._opened, ...this._desk.score.save() }));
    }
  }

  /** @param {Recording} recording */
  _recall(recording) {
    const kept = JSON.parse(sessionStorage.getItem(location.pathname) ?? "null");
    const isSame = kept?.opened === this._opened && kept.time <= recording.at("time", recording.count - 1)[0];
    if (isSame && kept.time > 0) this._desk.score?.restore(kept);
  }

  /** Puts the next instrument into the hand. */
  holdNext() {
    const { held, instruments } = this.status ?? { held: 0, instruments: [""] };
    this.send({ do: "hold", instrument: (held + 1) % instruments.length });
  }

  /** Whether another instrument can take the place of the held one without a new run. */
  get canExchange() {
    return (this.status?.isSteered && this.status.instruments.length > 1 && this.status.named[this.status.held]) ?? false;
  }

  /** Exchanges the held instrument: it is withdrawn, another one is chosen, and advanced over the wire. */
  async exchange() {
    if (!this.status || !this.canExchange || this.status.outcome) return;
    const { held, instruments, named: choices, chosen, exchangesAsked } = this.status;
    this.steering.release();
    const select = named("select", "what takes its place", {}, ...choices[held].map((name) =>
      make("option", { value: name, selected: name === chosen[held] }, name)));
    const answer = await ask(say("exchange {0}", instruments[held]), [make("ol", {}, make("li", {}, "Withdraw it: pull (S)."),
      make("li", {}, "Choose what takes its place: ", select), make("li", {}, "Advance that: push (W)."))],
    ["cancel", "exchange"]);
    if (answer !== "exchange") return;
    this._exchangesAsked = exchangesAsked + 1;
    this.send({ do: "exchange", instrument: held, name: select.value });
  }

  /** Says what came of an exchange. @param {Status} status */
  _answerExchange({ problem, instruments, held, exchangesAsked }) {
    if (exchangesAsked < this._exchangesAsked) return;
    this._exchangesAsked = Infinity;
    if (problem) ask("not exchanged", [make("p", {}, `${problem[0].toUpperCase()}${problem.slice(1)}.`)], ["close"]);
    else this._panel.tell([say("{0} has its tip where the other one had it: advance it", instruments[held])]);
  }

  /** @param {number} push @param {number} turn from -1 to 1 @param {number} otherPush of the next instrument
   * @param {number} otherTurn */
  _tell(push, turn, otherPush, otherTurn) {
    this._marks.set(++this._mark, performance.now());
    if (push || turn || otherPush || otherTurn) this._remind();
    this.send({ do: "hand", push, turn, otherPush, otherTurn, mark: this._mark });
  }

  /** Turns the held hub until it is there. @param {number} turn rad */
  _aim(turn) {
    this._remind();
    this.send({ do: "aim", turn });
  }

  /** Says that nothing moves while the run is paused. */
  _remind() {
    if (!this.status?.isPaused || this.status.isWaiting || this.status.outcome) return;
    this._steeredAt = performance.now();
    setTimeout(() => this.label(), REMINDED + 50);
    this.label();
  }

  /** @param {Status} status */
  async _hear(status) {
    const isNew = this.status?.opened !== status.opened;
    const before = this.status;
    this.status = status;
    if (status.isPaused) hum(0);
    if (isNew && status.opened) {
      byId("note").textContent = say("loading the vessel");
      const recorded = await this._connection.recording(status.opened);
      if (recorded) this._open(new Recording(recorded), status.opened);
    }
    if (isNew || before?.hand !== status.hand || before?.isFree !== status.isFree || status.hand) {
      this._controls.make(status);
      this.label();
    }
    this._coach.offer(status.hand && status.isSteered && !status.outcome);
    this._placeCoach();
    this._desk.hold(status.isSteered ? status.held : -1);
    this._watch(status.isSteered ? status.held : 0);
    this._panel.say([status.problem, status.outcome, ...(this.model?.recording.warnings ?? [])].filter(Boolean));
    this._answerExchange(status);
    if (status.problem) this.onProblem(status.problem);
  }

  _placeCoach() {
    if (this.model) this._coach.place(this.model.watchedTip);
  }

  /** Keeps the tip of an instrument in view. @param {number} instrument */
  _watch(instrument) {
    if (!this.model || this.model.watched === instrument) return;
    this.model.watched = instrument;
    this._stage.ask();
    this._xray.ask();
  }

  /** @param {Recording} recording @param {number} opened number of its scene */
  _open(recording, opened) {
    this._opened = opened;
    this.closeReport();
    for (const frame of this._early.filter(([, of]) => of === opened)) recording.append(frame.subarray(2));
    this._early = this._early.filter(([, of]) => of > opened);
    const exchanges = this.status?.exchanges.length ?? 0;
    const kept = this.model && exchanges > this._exchanged ? this._desk.score?.save() : null; // the run goes on
    this._exchanged = exchanges;
    this.model?.dispose();
    const isOther = this._shownScene !== this.status?.scene;
    this._shownScene = this.status?.scene;
    this.model = new Model(recording);
    this._stage.set([[this.model]]);
    this._panel.set([this.model], false);
    this._desk.set([recording]);
    this.injector.set(recording, Boolean(kept));
    if (kept) this._desk.score?.restore(kept);
    else {
      this._xray.fill(null);
      this._recall(recording);
    }
    this._back = null;
    this._isReported = Number.isFinite(this._desk.score?.reachedAt);
    this.show();
    if (isOther) this._xray.set([this.model]);
    else this._xray.keep([this.model], Boolean(kept));
    if (isOther) this._stage.frameAll(true);
    this.label();
    this.onOpened(this.status?.scene ?? "");
  }

  /** @param {ArrayBuffer} data */
  _take(data) {
    const numbers = new Float64Array(data);
    this.received++;
    this._newest = numbers[0];
    this.send({ do: "shown" });
    if (numbers[1] > this._opened) this._early.push(numbers);
    if (!this.model || numbers[1] !== this._opened) return;
    const { recording } = this.model;
    const before = recording.forgotten;
    recording.append(numbers.subarray(2));
    if (recording.forgotten > before) this._desk.score?.forget(recording.forgotten - before);
    this._back = null;
    this.model.frame = recording.count - 1;
    const time = recording.at("time", this.model.frame)[0];
    this._coach.pass(this.steering, time - (this._before ?? time));
    this._before = time;
    this._xray.beam.pass(time);
    this.show();
    this.label();
    this._placeCoach();
    if (!this._isReported && Number.isFinite(this._desk.score?.reachedAt)) this._succeed();
  }

  /** The target is reached: the run pauses, and its report is shown. */
  async _succeed() {
    this._isReported = true;
    this.steering.release();
    this.pause(true);
    await this.report();
  }

  /** Shows what the case came to, and does what is answered. */
  async report() {
    const { score } = this._desk;
    if (!this.model || !score || "debrief" in document.body.dataset) return;
    if (!this.status?.isPaused) this.pause(true);
    const { recording } = this.model;
    const isDone = Number.isFinite(score.reachedAt);
    const { seconds, pictures, spans } = this._xray.beam;
    const judged = this.mission && isDone ? judge(this.mission, score, seconds, this.injector.injected) : null;
    const best = this.mission && bestOf(this.mission.file);
    if (this.mission && judged) keepBest(this.mission.file, { ...judged.result, course: thinned(courseOf(recording, score.first)) });
    const ghost = best?.course ? { course: best.course, name: "ghost: your best" }
      : this.mission?.ghost ? { course: this.mission.ghost, name: "ghost: the recorded drive" } : null;
    this._ghost = ghost?.course ?? null;
    const answer = await this._debrief.show({ recording, score, beam: spans, ghost, stars: judged?.text ?? "",
      title: isDone ? "target reached" : "report",
      rows: rowsOf(recording, score, { case: this.title, beam: seconds, pictures, stars: judged?.text,
        contrast: this.injector.injected, exchanges: this.status?.exchanges ?? [] }),
      answers: isDone ? [...(this.mission ? ["all missions"] : []), "go on", "try again"] : ["close"] });
    this._back = this._ghost = null;
    this.show();
    this.label();
    if (answer === "try again") this.send({ do: "reset" });
    else if (answer === "go on") this.pause(false);
    else if (answer === "all missions") byId("gallery").click();
  }

  /** The report goes, where it is shown: something else is looked at. */
  closeReport() {
    this._debrief.close("");
  }

  /** The case as it is called. */
  get title() {
    const { scenes = [], titles = [], scene = "" } = this.status ?? {};
    return say(titles[scenes.indexOf(scene)] ?? nameOf(scene));
  }

  /** Shows the newest frame with what is chosen beside it. */
  show() {
    if (!this.model) return;
    const { recording } = this.model;
    const frame = this._back ?? recording.count - 1;
    this._panel.show([frame]);
    const now = recording.at("time", frame)[0];
    this.model.showGhost(this._ghost?.wire?.[Math.max(0, this._ghost.time.filter((time) => time <= now).length - 1)]);
    this._desk.show(frame);
    this._xray.ask();
    const slider = byId("back");
    if (slider) {
      slider.max = String(recording.count - 1);
      slider.value = String(frame);
    }
  }

  /** The newest frame, and the one that is looked at. */
  get frames() {
    const newest = (this.model?.recording.count ?? 1) - 1;
    return { newest, shown: this._back ?? newest };
  }

  /** Looks back, at a frame that is kept. @param {number} frame */
  lookBack(frame) {
    if (!this.model) return;
    this._back = frame < this.model.recording.count - 1 ? frame : null;
    this.show();
    this.label();
  }

  _shown() {
    for (const [mark, time] of this._marks) {
      if (mark > this._newest) continue;
      this._marks.delete(mark);
      this.delays.push(performance.now() - time);
    }
  }

  label() {
    if (!this.model) return;
    const { recording, frame } = this.model;
    const [time, step, stepTime] = ["time", "step", "stepTime"].map((name) => recording.at(name, frame)[0]);
    const rate = recording.at("realTime", frame)[0];
    this._stage.label(0, say("t = {0} s   step {1}", brief(time), step) + (Number.isFinite(rate)
      ? `\n${say("{0} ms a step: {1} times real time", brief(stepTime, 3), brief(rate, 3))}` : ""));
    const target = recording.described?.target;
    byId("title").textContent = this.title;
    byId("goal").textContent = this.mission ? say(this.mission.goal) : target ? say("to {0}", say(placeName(target.name))) : "";
    byId("par").textContent = this.mission ? say("par {0} s", this.mission.par) : "";
    if (!byId("start") || byId("start").hidden) document.title = `${this.title} · Guidewire`;
    this._note(rate);
  }

  /** Says beside the pictures what an operator may not see elsewhere. @param {number} rate times faster than real time */
  _note(rate) {
    const { isPaused, isWaiting, pace = 1, hand, isFree, outcome, isSteered } = this.status ?? {};
    const isReminded = isPaused && performance.now() - this._steeredAt < REMINDED;
    const isSlow = !isPaused && rate < SLOW * Math.min(pace, 1);
    const note = byId("note");
    note.classList.toggle("loud", Boolean(isReminded));
    byId("mood").textContent = note.textContent = isSlow && hand && !outcome && this._back === null ? say("slower than real time: {0} x", brief(rate, 2))
      : say(this._back !== null ? "looking back" : outcome ? "ended"
        : !hand ? (isFree ? "nobody is steering" : "watching: another page is steering")
        : this.status && this.isGone(this.status) ? "the simulation has ended unexpectedly: start anew" : isWaiting ? "ready: push to begin" : isReminded ? "paused: nothing moves until \"go on\" (space)"
        : isPaused ? "paused" : isSteered ? "" : "moved by the recorded drive");
  }

  /** Whether there is no runner any more. @param {Status} status */
  isGone(status) {
    return status.problem !== "" && !Object.keys(status.values).length;
  }

  /** Saves what was steered as files of the browser, one for each instrument. */
  async saveSteering() {
    if (!this.status) return;
    const { instruments, chosen, named } = this.status;
    const files = instruments.map((_, k) => (k === 0 ? "steered.csv" : `steered-${k}.csv`));
    for (const [k, file] of files.entries()) {
      const { ok, text } = await this._connection.steered(k);
      if (!ok) {
        this._panel.say([say("nothing was saved: {0}", text)]);
        return;
      }
      save(file, text, "text/csv");
    }
    const keys = files.map((file, k) => {
      const own = k === 0 ? "" : `catheters[${k - 1}].`;
      return `--set "${own}insertionSpeed=0" --set "${own}driveFile=${file}" `
        + (named.length && chosen[k] ? `--set "${own}instrument=${chosen[k]}" ` : "");
    }).join(""); // quotes that sh, zsh, PowerShell and cmd take alike
    const steps = this.model ? this.model.recording.at("step", this.model.recording.count - 1)[0] : 0;
    const command = `python3 guidewire.py run "${this.status.file}" ${keys}--set maxSimulationSteps=${steps} --set deltaThreshold=0`;
    this._panel.tell([say("{0}: put it where you start guidewire.py, and repeat the run there with", files.join(", ")), command]);
    const copy = make("button", { onclick: async () => {
      await navigator.clipboard.writeText(command);
      copy.textContent = say("copied");
    } }, "copy the command");
    byId("said").append("\n", copy);
  }
}

/** What a gamepad's button does with a card or the report: A answers, B closes, up chooses the next of its list.
 * @param {any} card @param {string} button */
function pressCard(card, button) {
  const select = card.querySelector("select");
  if (button === "pause") card.querySelector("button.on").click();
  else if (button === "inject") card.close?.();
  else if (button === "exchange" && select) select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
}

/** The same in the gallery: A opens the picture that is reached, the shoulders go to another one. @param {string} button */
function pressGallery(button) {
  const cards = /** @type {HTMLElement[]} */ ([...byId("start").querySelectorAll(".scenes button")]);
  const at = Math.max(0, cards.indexOf(/** @type {HTMLElement} */ (document.activeElement)));
  if (button === "pause") cards[at]?.click();
  else if (button === "hold" || button === "beam") cards[(at + (button === "beam" ? 1 : cards.length - 1)) % cards.length]?.focus();
}

/** A scene as one calls it. @param {string} file */
function nameOf(file) {
  return file.replace(/^.*\//, "").replace(/\.json$/, "").replaceAll("-", " ");
}

export const LIVE_KEYS = /** @type {[string, string][]} */ ([
  ["pads", "push pad: up and down; turn pad: sideways"], ["W S, up down", "push and pull"], ["A D, left right", "turn"], ["U J, K L", "push and pull, turn the next instrument"], ["G", "fine steering"], ["space", "pause, go on"], ["N", "one step"],
  ["R", "start anew"], ["I", "select the next instrument"], ["Q", "exchange it for another one"], ["E", "inject contrast"], ["gamepad", "left stick steers, right stick the next instrument; A pauses, B injects, X fine, Y starts anew, shoulders: next instrument, beam; up: exchange; in the gallery the shoulders choose and A opens"],
]);
