// @ts-check
import { Live, LIVE_KEYS } from "./live.js";
import { byId, Panel } from "./panel.js";
import { Recording } from "./recording.js";
import { Replay, REPLAY_KEYS } from "./replay.js";
import { Stage } from "./stage.js";

const stage = new Stage(byId("picture"), byId("panes"));
/** @type {Replay | Live | null} */
let shown = null;
const panel = new Panel(stage, () => {
  if (shown instanceof Replay) shown.show();
  else shown?.show();
});

/** Runs that stand in this file, where it works without a server. @type {ArrayBuffer[] | undefined} */
const packed = /** @type {any} */ (globalThis).guidewireRecordings;
const what = packed ? { isLive: false, recordings: packed.length } : await (await fetch("show.json")).json();
if (what.isLive) {
  shown = new Live(stage, panel);
} else {
  const load = async (/** @type {number} */ k) => (await fetch(`recording/${k}`)).arrayBuffer();
  const bytes = packed ?? await Promise.all([...Array(what.recordings).keys()].map(load));
  shown = new Replay(stage, panel, bytes.map((one) => new Recording(one)));
}

byId("hint").textContent = what.isLive ? "W push, S pull, A and D turn, space pause, H help" : "space play, H help";
byId("keys").textContent = `${what.isLive ? LIVE_KEYS : REPLAY_KEYS}
C  colour
F  contact forces
T  follow the tip
H  keys
mouse  orbit, shift, zoom`;
const toggles = /** @type {Record<string, string>} */ ({ f: "arrows", t: "follow" });
addEventListener("keydown", (event) => {
  const isTyped = event.target instanceof HTMLInputElement && event.target.type !== "range";
  if (isTyped || event.target instanceof HTMLSelectElement || event.ctrlKey || event.metaKey) return;
  if (event.target instanceof HTMLButtonElement) event.target.blur(); // or the space bar would press it again
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const pressed = key === event.key ? event : new KeyboardEvent("keydown", { key, repeat: event.repeat });
  if (shown?.key(pressed)) event.preventDefault();
  else if (key === "c") panel.nextColour();
  else if (key === "h") byId("keys").hidden = !byId("keys").hidden;
  else if (key in toggles) byId(toggles[key]).click();
});

/** For scripts that drive this page: what is shown, and the picture. */
Object.assign(globalThis, { viewer: { shown, stage } });
