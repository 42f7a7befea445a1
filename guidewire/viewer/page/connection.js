// @ts-check
/**
 * What a page says to whoever simulates, and hears: the server, or a worker of this browser.
 *
 * @typedef {import("./recording.js").Recorded} Recorded
 * @typedef {object} Connection
 * @property {(message: Record<string, any>) => void} send
 * @property {((message: import("./live.js").Status | import("./injector.js").Told | ArrayBuffer) => void)} onmessage status,
 *     contrast, or a frame
 * @property {((reason: string) => void)} onclose nobody simulates any more
 * @property {(opened: number) => Promise<Recorded | null>} recording of the scene that was opened last
 * @property {(instrument: number) => Promise<{ok: boolean, text: string}>} steered its drive table, or why there is none
 */
import { unpackRecording } from "./recording.js";

/** @implements {Connection} */
export class SocketConnection {
  constructor() {
    /** @type {Connection["onmessage"]} */
    this.onmessage = () => {};
    /** @type {Connection["onclose"]} */
    this.onclose = () => {};
    this._socket = new WebSocket(new URL("live", location.href.replace(/^http/, "ws")));
    this._socket.binaryType = "arraybuffer";
    this._socket.onmessage = ({ data }) => this.onmessage(typeof data === "string" ? JSON.parse(data) : data);
    this._socket.onclose = ({ reason }) => this.onclose(reason || "the server has ended: this page is no longer live");
  }

  /** @type {Connection["send"]} */
  send(message) {
    if (this._socket.readyState === WebSocket.OPEN) this._socket.send(JSON.stringify(message));
  }

  /** @type {Connection["recording"]} */
  async recording(opened) {
    const answer = await fetch(`recording/0?${opened}`);
    return answer.ok ? unpackRecording(await answer.arrayBuffer()) : null;
  }

  /** @type {Connection["steered"]} */
  async steered(instrument) {
    const answer = await fetch(instrument === 0 ? "steered.csv" : `steered-${instrument}.csv`);
    return { ok: answer.ok, text: await answer.text() };
  }
}

/** @implements {Connection} */
export class WorkerConnection {
  /** @param {{rules: Record<string, any>, scenes: {file: string, meshes: string[]}[]}} site */
  constructor(site) {
    /** @type {Connection["onmessage"]} */
    this.onmessage = () => {};
    /** @type {Connection["onclose"]} */
    this.onclose = () => {};
    /** Told what is being loaded, and the part of it that is there. @type {(what: string, part?: number, megabytes?: number) => void} */
    this.onloading = () => {};
    this._site = site;
    this._opened = this._number = this._awaited = 0;
    /** Whether the worker steps: it is not loading, nor opening a scene. */
    this._isReady = false;
    /** What opened the scene that is shown, with its instruments and files: an ended worker's successor does it anew.
     * @type {Record<string, any>[]} */
    this._story = [];
    /** @type {Recorded | null} */
    this._recording = null;
    /** @type {((tables: {tables: string[], refused?: string}) => void)[]} */
    this._asked = [];
    this._begin();
  }

  _begin() {
    this._isReady = false;
    const { rules, scenes } = this._site;
    this._worker = new Worker(new URL("worker.js", document.baseURI), { type: "module" });
    this._worker.onmessage = ({ data }) => this._hear(data);
    this._worker.onerror = (error) => this.onclose(`this browser cannot simulate: ${error.message || "its worker ended"}`);
    this._worker.postMessage({ begin: { rules, scenes: scenes.map(({ file }) => file), opened: this._opened,
      meshes: Object.fromEntries(scenes.map(({ file, meshes }) => [file, meshes])) } });
  }

  /** Gives up what is being loaded: another worker begins with nothing open. */
  cancel() {
    clearTimeout(this._timer);
    this._worker?.terminate();
    [this._story, this._recording] = [[], null];
    this._begin();
  }

  /** @type {Connection["send"]} */
  send(message) {
    if (message.do === "open") this._story = [message];
    else if (message.do === "name") this._story.push(message);
    this._worker?.postMessage({ message, number: ++this._number });
    if (!["open", "name", "reset"].includes(message.do) || !this._isReady) return;
    this._watch(this._number);
    this._isReady = message.do === "reset";
  }

  /** A worker that does not hear for long is in a step that does not end: another takes its place.
   * @param {number} number of the message */
  _watch(number) {
    clearTimeout(this._timer);
    this._timer = setTimeout(() => {
      this._worker?.terminate();
      this._begin();
      for (const message of this._story) this._worker?.postMessage({ message, number });
    }, 1000 * this._site.rules.patience);
    this._awaited = number;
  }

  /** @param {any} data */
  _hear(data) {
    if (data.loading) this.onloading(data.loading, data.part, data.megabytes);
    if (data.heard >= this._awaited) clearTimeout(this._timer);
    if (data.recording) [this._recording, this._opened] = [data.recording, data.opened];
    if (data.frame) this.onmessage(data.frame);
    if (data.status) {
      this._isReady = true;
      this.onmessage(data.status);
    }
    if (data.agent) this.onmessage(data);
    if (data.tables) this._asked.splice(0).forEach((answer) => answer(data));
    if (data.gone) this.onclose(data.gone);
  }

  /** @type {Connection["recording"]} */
  async recording(opened) {
    return opened === this._opened ? this._recording : null;
  }

  /** @type {Connection["steered"]} */
  async steered(instrument) {
    const { tables, refused } = await new Promise((answer) => {
      this._asked.push(answer);
      this._worker?.postMessage({ message: { do: "steered" } });
    });
    return { ok: !refused, text: refused || tables[instrument] };
  }
}
