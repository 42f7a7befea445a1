// @ts-check
import { SocketConnection, WorkerConnection } from "./connection.js";
import { Desk } from "./desk.js";
import { Live, LIVE_KEYS } from "./live.js";
import { byId, make, named, Panel } from "./panel.js";
import { Recording, unpackRecording } from "./recording.js";
import { Replay, REPLAY_KEYS } from "./replay.js";
import { Stage } from "./stage.js";
import { offer } from "./start.js";
import { choose, language, LANGUAGES, say, translate } from "./words.js";
import { Xray } from "./xray.js";

await translate();

const stage = new Stage(byId("picture"), byId("panes"));
const desk = new Desk();
const xray = new Xray();
if (!stage.isDrawn) {
  document.body.dataset.views = "xray";
  byId("notice").textContent = say("No WebGL 2 in this browser: the X-ray picture is drawn plainly and there is no 3D picture, until you "
    + "switch on hardware acceleration or take another browser.");
  byId("notice").hidden = false;
}
const isTogether = () => xray.together.getAttribute("aria-pressed") === "true";
xray.together.onclick = () => {
  xray.together.setAttribute("aria-pressed", String(!isTogether()));
  if (isTogether()) stage.look(xray.arm);
};
xray.onTurned = () => isTogether() && stage.look(xray.arm);
stage.onTurned = (towards) => isTogether() && xray.lookFrom(towards);
/** @type {Replay | Live | null} */
let shown = null;
const panel = new Panel(stage, () => shown?.show());

/** Runs that stand in this file, where it works without a server. @type {ArrayBuffer[] | undefined} */
const packed = /** @type {any} */ (globalThis).guidewireRecordings;
const load = async (/** @type {string} */ name) => {
  const answer = await fetch(name);
  if (answer.ok) return answer;
  throw byId("unstarted").textContent = say("{0} is missing on this server ({1}): copy the whole folder there again.", name, answer.status);
};
const what = packed ? { isLive: false, recordings: packed.length } : await (await load("show.json")).json();
if (what.isLive) {
  const connection = what.site ? new WorkerConnection(what.site) : new SocketConnection();
  const live = shown = new Live(stage, panel, desk, xray, connection);
  if (connection instanceof WorkerConnection) offer(what.site, live, connection);
} else {
  const bytes = packed ?? await Promise.all([...Array(what.recordings).keys()].map(async (k) =>
    (await load(`recording/${k}`)).arrayBuffer()));
  shown = new Replay(stage, panel, desk, xray, bytes.map((one) => new Recording(unpackRecording(one))));
}
byId("unstarted").remove();

const NO_KEYS = ["pads", "gamepad", "X-ray", "3D"];
const keys = byId("keys");
let hasPaused = false; // for as long as one reads
const showHelp = (/** @type {boolean} */ isShown) => {
  keys.hidden = !isShown;
  if (shown instanceof Live) {
    if (isShown ? shown.status && !shown.status.isPaused : hasPaused) shown.pause(isShown);
    hasPaused = isShown && !shown.status?.isPaused;
  }
  byId("help").setAttribute("aria-expanded", String(isShown));
  if (isShown) /** @type {HTMLElement} */ (keys.lastElementChild).focus();
};
keys.replaceChildren(
  make("h2", {}, what.isLive ? "You steer the wire at its hub" : "A replay"),
  make("table", {}, ...[...(what.isLive ? LIVE_KEYS : REPLAY_KEYS), ["X-ray", "drag turns the C-arm, wheel or + and − zoom"],
    ["3D", "drag orbits, wheel zooms"], ["V", "the views one after the other"], ["X", "pedal: beam on or off"], ["Shift + arrows", "move the table"], ["C", "colour of the wire"],
    ["F, T", "contact forces; keep the tip in view"], ["H", "this list"]].map(([key, text]) =>
    make("tr", { className: NO_KEYS.includes(key) ? "" : "byKey" },
      make("td", {}, ...key.split(", ").flatMap((part, k) => [k ? ", " : "", make("kbd", {}, part)])),
      make("td", {}, text)))),
  named("select", "language", { onchange: () => choose(keys.querySelector("select").value) },
    ...Object.entries(LANGUAGES).map(([value, name]) => make("option", { value, selected: value === language }, name))),
  make("button", { onclick: () => showHelp(false) }, "got it"));
byId("help").onclick = () => showHelp(keys.hidden);

const VIEWS = ["both", "space", "xray", "biplane"];
const showViews = (/** @type {string} */ which) => {
  document.body.dataset.views = which;
  for (const button of byId("armTools").querySelectorAll("button[data-views]")) {
    button.setAttribute("aria-pressed", String(button.dataset.views === which));
    button.onclick = () => showViews(button.dataset.views);
  }
  xray.ask();
  stage.ask();
};
xray.onViews = () => showViews(document.body.dataset.views ?? "both");
xray.onViews();
byId("swap").onclick = () => showViews(document.body.dataset.views === "space" ? "both" : "space");
const setTheme = (/** @type {string} */ theme) => {
  document.documentElement.dataset.theme = theme;
  byId("theme").textContent = say(theme === "light" ? "dark" : "light");
  stage.setTheme(theme);
  shown?.show();
};
setTheme(matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark");
byId("theme").onclick = () => setTheme(document.documentElement.dataset.theme === "light" ? "dark" : "light");

/** Degrees of LAO and cranial by key. @type {Record<string, [number, number]>} */
const ARM = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] };
const TABLE = 0.01; // of the picture's side for 5 degrees of the other keys
const toggles = /** @type {Record<string, string>} */ ({ f: "arrows", t: "follow" });
/** What takes keys itself: fields, and an open card. @param {EventTarget | null} target */
const takesKeys = (target) => (target instanceof HTMLInputElement && !["range", "checkbox", "file"].includes(target.type))
  || byId("card").open || !byId("start").hidden || "debrief" in document.body.dataset;
/** Keys that belong to what a keyboard has reached. @param {EventTarget | null} target @param {string} key */
const isOwn = (target, key) => target instanceof HTMLElement && (key === "Enter" || key === " "
  ? target.matches("button, summary, a, select, input") : target.matches("input, select") && key.startsWith("Arrow"));
// Where a pointer has pressed, the keys go on steering.
addEventListener("click", ({ target, detail }) => detail > 0 && target instanceof Element
  && /** @type {HTMLElement | null} */ (target.closest("button, summary, input:not([type=number])"))?.blur());
// What opens over the page closes with a click elsewhere.
const closeMenus = (/** @type {EventTarget | null} */ target) => document.querySelectorAll("details:has(> .sheet)[open]").forEach((menu) => {
  if (!menu.contains(/** @type {Node} */ (target))) menu.removeAttribute("open");
});
addEventListener("pointerdown", ({ target }) => closeMenus(target));
// A list gives the focus back; while it has it, keys steer, but those that open it.
addEventListener("change", ({ target }) => target instanceof HTMLSelectElement && target.blur());
addEventListener("keydown", (event) => {
  if (event.key === "Escape") {
    closeMenus(null);
    if (shown instanceof Live) shown.closeReport();
  }
  if (takesKeys(event.target) || event.ctrlKey || event.metaKey) return;
  if (event.key === "Tab" || event.key === "F4" || isOwn(event.target, event.key)) return;
  if (event.target instanceof HTMLSelectElement && event.altKey) return;
  if (event.target instanceof HTMLSelectElement && event.key.length === 1) event.preventDefault();
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  const pressed = key === event.key ? event : new KeyboardEvent("keydown", { key, repeat: event.repeat });
  if (event.shiftKey && key.startsWith("Arrow")) {
    const [across, down] = ARM[key] ?? [0, 0];
    xray.pan(-TABLE * across, TABLE * down);
    event.preventDefault();
  } else if (event.altKey && key.startsWith("Arrow")) {
    const [lao, cranial] = ARM[key] ?? [0, 0];
    xray.turnArm(lao, cranial);
    event.preventDefault();
  } else if (shown?.key(pressed)) {
    event.preventDefault();
    if (!keys.hidden) showHelp(false);
  } else if (key === "x") xray.beam.set(!xray.beam.isOn);
  else if (key === "c") panel.nextColour();
  else if (key === "h" || (key === "Escape" && !keys.hidden)) showHelp(keys.hidden);
  else if (key === "v") showViews(VIEWS[(VIEWS.indexOf(document.body.dataset.views ?? "both") + 1) % VIEWS.length]);
  else if (key in toggles) byId(toggles[key]).click();
});

/** For scripts that drive this page: what is shown, and the pictures. */
Object.assign(globalThis, { viewer: { shown, stage, xray } });
