// @ts-check
/** Where a page without a server begins: its missions as pictures, the scene of the address, and files of one's own. */
import { bestOf, missionOf, starsOf } from "./missions.js";
import { byId, make, named } from "./panel.js";
import { fixed, say } from "./words.js";

/**
 * @typedef {{file: string, title: string, sentence: string, picture: string, meshes: string[],
 *     mission?: import("./missions.js").Mission}} Scene
 * @typedef {import("./rims.js").OwnFile} OwnFile
 */

const BEHIND = ["header", "main", "aside", "footer"]; // what the gallery covers

/**
 * @param {{scenes: Scene[], wire: Record<string, any>}} site @param {import("./live.js").Live} live
 * @param {import("./connection.js").WorkerConnection} connection
 */
export function offer(site, live, connection) {
  const box = byId("start");
  const said = make("p", { role: "alert" });
  const loading = new Loading(() => {
    connection.cancel();
    live.forget();
    showGallery();
  });

  const cover = (/** @type {boolean} */ isCovered) => {
    box.hidden = !isCovered;
    for (const one of BEHIND) /** @type {any} */ (document.querySelector(one)).inert = isCovered;
  };
  const showGallery = (problem = "") => {
    loading.end();
    live.closeReport();
    if (live.status && !live.status.isPaused) live.pause(true);
    said.textContent = problem;
    const missions = site.scenes.filter(({ mission }) => mission);
    const next = missions.find(({ file }) => !bestOf(file));
    const stars = missions.reduce((sum, { file }) => sum + (bestOf(file)?.stars ?? 0), 0);
    const practice = site.scenes.filter(({ mission }) => !mission);
    const cards = (/** @type {Scene[]} */ scenes) => make("div", { className: "scenes" },
      ...scenes.map((scene) => card(scene, scene === next, open)), ...(scenes.includes(site.scenes[0]) ? [own] : []));
    const own = make("label", { className: "own" }, make("strong", {}, "Your own vessel or scene"), make("br", {}),
      "Drop a mesh (.obj, .stl, mm), a parameter file with its meshes, or the folder of a vessel, or ", input,
      " Of a mesh alone the widest open end is the inlet. Files stay in this browser.");
    box.replaceChildren(make("h1", {}, "Guidewire"), make("p", {}, "Steer a wire through a vessel, by X-ray."),
      ...(missions.length ? [make("p", { className: "stars" }, say("{0} of {1} ★", stars, 3 * missions.length))] : []), said,
      ...(missions.length ? [cards(missions)] : []),
      ...(practice.length ? [make("h2", {}, "Free practice"), cards(practice)] : []));
    cover(true);
    /** @type {HTMLElement | null} */ (box.querySelector(".next, .scenes button"))?.focus({ preventScroll: true });
    document.title = "Guidewire";
  };

  const open = (/** @type {string} */ scene) =>
    live.leave(say("open {0}", say(site.scenes.find(({ file }) => file === scene)?.title ?? scene)), () => {
      loading.show("loading the simulator");
      connection.send({ do: "open", scene });
    });
  const take = async (/** @type {() => Promise<OwnFile[]>} */ read) => {
    loading.show("reading your files");
    const files = await read();
    live.leave(say("open {0}", files[0]?.path ?? ""), () => connection.send({ do: "open", scene: "", files, wire: site.wire }), () => loading.end());
  };
  const refuse = (/** @type {string} */ why) => {
    loading.end();
    if (!live.model) showGallery(why);
    else if (box.hidden) byId("said").textContent = why;
    else said.textContent = why;
  };
  const input = make("input", { type: "file", multiple: true, onchange: () =>
    take(() => Promise.all([...input.files].map((file) => readFile(file, file.name)))) });
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    const { dataTransfer } = event;
    if (dataTransfer?.items.length) take(readDropped(dataTransfer));
  });

  connection.onloading = (what, part, megabytes) => !byId("loading").hidden && loading.show(what, part, megabytes); // later ones are of no use
  live.onOpened = (scene) => {
    loading.end();
    cover(false);
    live.mission = missionOf(site.scenes, scene);
    const address = site.scenes.some(({ file }) => file === scene) ? `?scene=${nameOf(scene)}` : `?own=${nameOf(scene)}`;
    if (address !== location.search) history.pushState(null, "", address);
  };
  live.onProblem = refuse;
  const gallery = byId("gallery");
  gallery.hidden = false;
  gallery.onclick = () => {
    history.pushState(null, "", location.pathname);
    route();
  };
  const route = () => {
    const asked = new URLSearchParams(location.search);
    const name = asked.get("scene") ?? asked.get("own");
    const found = site.scenes.find(({ file }) => nameOf(file) === asked.get("scene"));
    const isShown = live.model && name !== null && nameOf(live.status?.scene ?? "") === name;
    if (isShown) {
      cover(false);
      live.show();
      live.label();
    } else if (found) open(found.file);
    else {
      showGallery(asked.has("own") ? say("Files of your own are not kept: drop them again.")
        : name === null ? "" : say("there is no scene \"{0}\" here: choose one of these", name));
    }
  };
  addEventListener("popstate", route);
  route();
}

/** A mission as a picture that opens it. @param {Scene} scene @param {boolean} isNext @param {(file: string) => void} open */
function card({ file, title, sentence, picture, mission }, isNext, open) {
  const best = mission && bestOf(file);
  const made = make("button", { onclick: () => open(file) }, make("img", { src: picture, alt: "" }),
    make("strong", {}, title),
    make("span", {}, mission ? mission.goal : sentence),
    ...(mission ? [make("span", { className: "par" }, say("par {0} s", mission.par) + (best ? say(", best {0} s", fixed(best.time, 1)) : ""),
      make("b", { title: best ? "your best" : "not won yet" }, starsOf(best?.stars ?? 0)))] : []),
    ...(isNext ? [make("em", {}, "next for you")] : []));
  if (isNext) made.className = "next";
  return made;
}

/** Says what is loaded, and how far, over the page. */
class Loading {
  /** @param {() => void} cancel */
  constructor(cancel) {
    this._said = make("p", { role: "status" });
    this._bar = named("progress", "loading", { max: 1 });
    byId("loading").replaceChildren(this._said, this._bar, make("button", { onclick: cancel }, "cancel"));
  }

  /** @param {string} what @param {number} [part] from 0 to 1; none: not known @param {number} [megabytes] so far */
  show(what, part, megabytes) {
    byId("loading").hidden = false;
    const said = say(what);
    this._said.textContent = `${said[0].toUpperCase()}${said.slice(1)}${megabytes ? `, ${fixed(megabytes, 1)} MB` : ""}.`;
    if (part === undefined) this._bar.removeAttribute("value");
    else this._bar.value = part;
  }

  end() {
    byId("loading").hidden = true;
  }
}

/** @param {string} file */
function nameOf(file) {
  return file.replace(/^.*\//, "").replace(/\.json$/, "");
}

/** @param {File} file @param {string} path @returns {Promise<OwnFile>} */
async function readFile(file, path) {
  return { path, bytes: new Uint8Array(await file.arrayBuffer()) };
}

/** All files, those in folders too. @param {DataTransfer} dropped @returns {() => Promise<OwnFile[]>} */
function readDropped(dropped) {
  const entries = [...dropped.items].map((item) => item.webkitGetAsEntry()).filter(Boolean); // gone after the event
  /** @type {OwnFile[]} */
  const files = [];
  const read = async (/** @type {any} */ entry) => {
    if (entry.isFile) {
      const file = await new Promise((done, failed) => entry.file(done, failed));
      files.push(await readFile(file, entry.fullPath.slice(1)));
      return;
    }
    const reader = entry.createReader();
    for (let some; (some = await new Promise((done, failed) => reader.readEntries(done, failed))).length;) {
      await Promise.all(some.map(read));
    }
  };
  return async () => {
    await Promise.all(entries.map(read));
    return files;
  };
}
