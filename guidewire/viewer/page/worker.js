// @ts-check
/** Simulates for a page without a server: the core, compiled for browsers, with the files that a scene names. */
import { sceneAmong } from "./rims.js";
import { Refusal, Run } from "./run.js";

/** @param {string} name of a file that is stored packed @param {string} [type] */
const unpack = async (name, type = "application/octet-stream") => {
  const answer = await fetch(new URL(`${name}.gz`, location.href));
  if (!answer.ok || !answer.body) {
    throw new Error(`${name} is missing on this server (${answer.status}): copy the whole folder of the site there again`);
  }
  loading.size += Number(answer.headers.get("Content-Length"));
  return new Response(answer.body.pipeThrough(counted()).pipeThrough(new DecompressionStream("gzip")), { headers: { "Content-Type": type } });
};

/** Bytes that were asked for, and those that came. */
const loading = { what: "loading the simulator", size: 0, come: 0, told: 0 };
const counted = () => new TransformStream({ transform: (chunk, out) => {
  loading.come += chunk.length;
  out.enqueue(chunk);
  if (performance.now() < loading.told + 100) return;
  loading.told = performance.now();
  postMessage({ loading: loading.what, megabytes: loading.come / 1e6, part: Math.min(1, loading.come / Math.max(loading.size, loading.come)) });
} });

/** The interpreter compiles a trace that has run 500 times; without this it waits for 5,000. */
const OPTIONS = ["--jiterpreter-minimum-trace-hit-count=500"];

/** What the last steps left. */
let numbers = new Float64Array(0);

/** @type {any} */ (globalThis).dotnetSidecar = true; // or the framework takes this worker for a thread of its own

const start = async () => {
  const { dotnet } = await import(/** @type {any} */ (new URL("framework/dotnet.js", location.href).href));
  const [runtime, texts] = await Promise.all([
    dotnet.withConfig({ runtimeOptions: OPTIONS }).withResourceLoader((/** @type {string} */ type, /** @type {string} */ name) =>
      (type === "dotnetjs" ? null : unpack(`framework/${name}`, type === "dotnetwasm" ? "application/wasm" : undefined)))
      .create(),
    unpack("texts.json").then((answer) => answer.json()),
  ]);
  runtime.setModuleImports("worker", { give: (/** @type {any} */ view) => { numbers = view.slice(); } });
  const { Exports } = (await runtime.getAssemblyExports("Guidewire.Browser")).Guidewire.Browser;
  await runtime.runMain("Guidewire.Browser", ["/"]);
  const encoder = new TextEncoder();
  for (const [name, text] of Object.entries(texts)) Exports.Write(`/${name}`, encoder.encode(text));
  return Exports;
};
const starting = start().catch((error) => {
  throw new Error("the simulator cannot be loaded: copy the whole folder of the site onto this server again, or take a newer "
    + `browser (${error.message})`);
});

/** @param {any} exports @returns {import("./run.js").Program} */
function programOf(exports) {
  const read = (/** @type {string} */ text) => {
    const answer = JSON.parse(text);
    if (answer.exitCode !== 0) throw new Refusal(answer.message.replace(/^request: /, ""));
    return answer;
  };
  return {
    ask: (request) => read(exports.Ask(JSON.stringify(request))),
    step: (motion, steps) => {
      if (!exports.Step(motion, steps)) read(exports.Ask(""));
      return numbers;
    },
    walls: () => exports.Walls(),
  };
}

/** @type {Promise<Run> | null} */
let running = null;
/** Files of the site that are not there yet, by the scene that names them. @type {Record<string, string[]>} */
let missing = {};

/** One message after another, as they come. */
let before = Promise.resolve();
onmessage = ({ data }) => {
  postMessage({ heard: data.number });
  before = before.then(() => hear(data)).catch((error) => postMessage({ gone: error.message }));
};

/** @param {any} data */
async function hear(data) {
  if (data.begin) {
    const { rules, scenes, meshes, opened } = data.begin;
    missing = meshes;
    running = starting.then((exports) =>
      new Run(programOf(exports), rules, scenes, opened, (message) =>
        postMessage(message, { transfer: message.frame ? [message.frame] : [] })));
    return;
  }
  const [exports, run] = [await starting, /** @type {Run} */ (await running)];
  if (data.message.do === "open") {
    const { files: own } = data.message;
    if (own) {
      data.message.scene = sceneAmong(own, data.message.wire, (what, part) => postMessage({ loading: what, part }));
      for (const { path, bytes } of own) exports.Write(`/${path}`, bytes);
    }
    const names = missing[data.message.scene] ?? [];
    Object.assign(loading, { what: "loading the vessel", size: 0, come: 0 });
    const files = await Promise.all(names.map(async (name) => (await unpack(`files/${name}`)).arrayBuffer()));
    files.forEach((bytes, k) => exports.Write(`/${names[k]}`, new Uint8Array(bytes)));
    delete missing[data.message.scene];
    postMessage({ loading: "putting the wire into the vessel" });
  }
  if (data.message.do !== "steered") run.hear(data.message);
  else {
    try {
      postMessage({ tables: run.tables() });
    } catch (error) {
      postMessage({ tables: [], refused: /** @type {Error} */ (error).message });
    }
  }
}
