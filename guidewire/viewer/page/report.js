// @ts-check
import { ask } from "./dialog.js";
import { make } from "./panel.js";
import { newtons } from "./score.js";
import { placeName } from "./target.js";

/** @typedef {import("./score.js").Score} Score */

/**
 * What a case came to, row by row.
 * @param {import("./recording.js").Recording} recording @param {Score} score
 * @param {{case: string, beam: number, pictures: number, contrast: number, exchanges: string[],
 *     stars?: string}} more s with the beam on, ml, and instruments that were exchanged
 * @returns {[string, string][]}
 */
export function rowsOf(recording, score, more) {
  const millimetres = recording.millimetres;
  const target = recording.described?.target;
  const isReached = Number.isFinite(score.reachedAt);
  const forces = recording.channels.get("hubForce")?.unit === "N";
  return [
    ["case", more.case],
    ...(target ? /** @type {[string, string][]} */ ([["target", `${placeName(target.name)}, ${
      isReached ? `reached at ${score.reachedAt.toFixed(1)} s` : `${(millimetres * score.left).toFixed(0)} mm away`}`],
    ["score", `${score.points} of 100`]]) : []),
    ...(more.stars ? /** @type {[string, string][]} */ ([["stars", more.stars]]) : []),
    ["time", `${score.time.toFixed(1)} s`],
    ["radiation", `${more.beam.toFixed(1)} s with the beam on, ${Math.round(more.pictures)} pictures`],
    ["contrast", `${more.contrast.toFixed(1)} ml`],
    ...(forces ? /** @type {[string, string][]} */ ([["largest force at the hub", newtons(score.hubForce)],
      ["largest wall force", newtons(score.wallForce)],
      ["wall force in the yellow band", `${score.caution.toFixed(1)} s`],
      ["wall force in the red band", `${score.stop.toFixed(1)} s`]]) : []),
    ["way of the tip", `${(millimetres * score.path).toFixed(0)} mm${target
      ? ` for ${(millimetres * (target.distances.at(-1) ?? 0)).toFixed(0)} mm from the inlet` : ""}`],
    ["new attempts", String(score.retries)],
    ...more.exchanges.map((text) => /** @type {[string, string]} */ (["exchange", text])),
    ["events", String(score.mishaps.length)],
    ...score.mishaps.map(({ time, text }) => /** @type {[string, string]} */ ([`at ${time.toFixed(1)} s`, text])),
  ];
}

/**
 * Shows it, and saves it as a file where that is wanted.
 * @param {[string, string][]} rows @param {string} title @param {string[]} answers beside "save report"
 * @returns {Promise<string>} the answer
 */
export async function showReport(rows, title, answers) {
  for (;;) {
    const answer = await ask(title, [make("dl", { id: "report" },
      ...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]))], ["save report", ...answers]);
    if (answer !== "save report") return answer;
    const text = rows.map(([name, value]) => `${name}: ${value}\n`).join("");
    save("report.txt", text, "text/plain");
  }
}

/** Gives the browser a file to save. @param {string} name @param {BlobPart} content @param {string} type */
export function save(name, content, type) {
  const link = make("a", { href: URL.createObjectURL(new Blob([content], { type })), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
}
