// @ts-check
// Starts a page whose modules are packed, beside it or in the page itself: each gets an address of its own.
const unpack = (/** @type {any} */ stream) => new Response(stream.pipeThrough(new DecompressionStream("gzip")));
const packedIn = (/** @type {any} */ node) =>
  new Blob([Uint8Array.from(atob(node.textContent), (character) => character.charCodeAt(0))]).stream();
const IMPORT = /^((?:import|export)[\w\s{},*$]*)(["'])(?:\.\/|three\/addons\/controls\/)?([\w.]+)\2/gm;

const start = async () => {
  const inside = document.querySelector("script[data-modules]");
  const modules = await unpack(inside ? packedIn(inside) : (await fetch("page.json.gz")).body).json();
  /** @type {any} */ (globalThis).guidewireWords = modules;
  /** @type {Record<string, string>} */
  const addresses = {};
  const link = (/** @type {string} */ name) => {
    const linked = (/** @type {string[]} */ ...[, word, , file]) =>
      `${word}"${link(file === "three" ? "three.module.js" : file)}"`;
    addresses[name] ??= URL.createObjectURL(new Blob([modules[name].replace(IMPORT, linked)],
      { type: "text/javascript" }));
    return addresses[name];
  };
  const recordings = [...document.querySelectorAll("script[data-recording]")];
  if (inside) {
    /** @type {any} */ (globalThis).guidewireRecordings =
      await Promise.all(recordings.map((node) => unpack(packedIn(node)).arrayBuffer()));
  }
  await import(link("main.js"));
};
start().catch((error) => {
  const said = /** @type {HTMLElement} */ (document.getElementById("unstarted"));
  if (typeof error !== "string") said.textContent = `This browser cannot show the page: take a newer one (${error.message}).`;
});
