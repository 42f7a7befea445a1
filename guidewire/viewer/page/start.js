// @ts-check
/** Where a page without a server begins: its scenes as pictures, the scene of the address, and files of one's own. */
import { byId, make } from "./panel.js";
import { sceneOf } from "./rims.js";

/**
 * @typedef {{file: string, title: string, sentence: string, picture: string, meshes: string[]}} Scene
 * @typedef {{path: string, bytes: Uint8Array}} OwnFile
 */

/**
 * @param {{scenes: Scene[], wire: Record<string, any>}} site @param {import("./connection.js").Connection} connection
 */
export function offer(site, connection) {
  const box = byId("start");
  const said = make("p", { role: "alert" });
  const open = (/** @type {string} */ scene, /** @type {OwnFile[]} */ files = []) => {
    box.hidden = true;
    if (!files.length) history.replaceState(null, "", `?scene=${nameOf(scene)}`);
    connection.send({ do: "open", scene, files });
  };
  const take = async (/** @type {Promise<OwnFile[]>} */ reading) => {
    try {
      const files = await reading;
      open(sceneAmong(files, site.wire), files);
    } catch (error) {
      show();
      said.textContent = /** @type {Error} */ (error).message;
      box.hidden = false;
    }
  };
  const input = make("input", { type: "file", multiple: true, onchange: () =>
    take(Promise.all([...input.files].map((file) => readFile(file, file.name)))) });
  const show = () => box.replaceChildren(make("h1", {}, "Guidewire"), make("p", {}, "Steer a guidewire through a vessel: choose a scene."),
    said, make("div", { className: "scenes" }, ...site.scenes.map((scene) =>
      make("button", { onclick: () => open(scene.file) }, make("img", { src: scene.picture, alt: "" }),
        make("strong", {}, scene.title), make("span", {}, scene.sentence)))),
    make("label", {}, "Your own: drop a parameter file with its meshes, or the folder of a vessel, or ", input,
      " Of a mesh alone (.obj, .stl, mm) the widest open end is the inlet. Files stay in this browser."));
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    if (event.dataTransfer?.items.length) take(readDropped(event.dataTransfer));
  });
  const asked = new URLSearchParams(location.search).get("scene");
  const found = site.scenes.find(({ file }) => nameOf(file) === asked);
  if (found) {
    open(found.file);
    return;
  }
  show();
  box.hidden = false;
  if (asked) said.textContent = `there is no scene "${asked}" here: choose one of these`;
}

/** @param {string} file */
function nameOf(file) {
  return file.replace(/^.*\//, "").replace(/\.json$/, "");
}

/** The parameter file of those that were dropped: scene.json of a vessel's folder, or the only one. For a mesh alone one
 * is added. @param {OwnFile[]} files @param {Record<string, any>} wire */
function sceneAmong(files, wire) {
  const all = files.map(({ path }) => path).filter((path) =>
    path.endsWith(".json") && !/(^|\/)(instruments\/.*|[^/]*anatomy\.json$)/.test(path));
  const scene = all.find((path) => /(^|\/)scene\.json$/.test(path)) ?? all[0];
  if (scene) return scene;
  const mesh = files.find(({ path }) => /\.(obj|stl)$/.test(path));
  if (!mesh) {
    throw new Error(`${files.map(({ path }) => path).join(", ")}: neither a parameter file (.json) nor a mesh (.obj, .stl)`);
  }
  const made = sceneOf(mesh.path, mesh.bytes, wire);
  const add = (/** @type {string} */ path, /** @type {object} */ content) =>
    files.push({ path, bytes: new TextEncoder().encode(JSON.stringify(content)) });
  add(`${mesh.path}.ends.json`, made.ends);
  add(`${mesh.path}.json`, made.scene);
  return `${mesh.path}.json`;
}

/** @param {File} file @param {string} path @returns {Promise<OwnFile>} */
async function readFile(file, path) {
  return { path, bytes: new Uint8Array(await file.arrayBuffer()) };
}

/** All files, those in folders too. @param {DataTransfer} dropped */
async function readDropped(dropped) {
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
  await Promise.all([...dropped.items].map((item) => item.webkitGetAsEntry()).filter(Boolean).map(read));
  return files;
}
