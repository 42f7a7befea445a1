// @ts-check
/**
 * A scene with something to achieve. It stands in guidewire/viewer/cases.py, and a test wins it with a recorded drive.
 * @typedef {{goal: string, par: number, ghost?: import("./report.js").Course}} Mission what is to be reached, a good time for
 *     it, s, and the course of that drive
 * @typedef {{stars: number, time: number, points: number, course?: import("./report.js").Course}} Result
 */
import { say } from "./words.js";

const GENTLE = 90; // points, which only wall forces lower once the target is reached
const SPARING = 10; // ml of contrast

/** @param {{file: string, mission?: Mission}[]} scenes @param {string} file @returns {(Mission & {file: string}) | null} */
export function missionOf(scenes, file) {
  const mission = scenes.find((scene) => scene.file === file)?.mission;
  return mission ? { ...mission, file } : null;
}

/**
 * Stars for time, wall force, and radiation with contrast, of a mission whose target is reached.
 * @param {Mission} mission @param {{reachedAt: number, points: number}} score @param {number} beam s @param {number} contrast ml
 * @returns {{result: Result, text: string}}
 */
export function judge({ par }, { reachedAt, points }, beam, contrast) {
  const parts = /** @type {[boolean, string][]} */ ([
    [reachedAt <= par, say("within {0} s", par)], [points >= GENTLE, say("{0} points for low wall forces", GENTLE)],
    [beam <= par && contrast <= SPARING, say("beam for at most {0} s with at most {1} ml", par, SPARING)]]);
  const stars = parts.filter(([isWon]) => isWon).length;
  const missed = parts.filter(([isWon]) => !isWon).map(([, text]) => text);
  return { result: { stars, time: reachedAt, points },
    text: `${starsOf(stars)}${missed.length ? say(", missed: {0}", missed.join("; ")) : ""}` };
}

/** @param {number} count */
export function starsOf(count) {
  return "★".repeat(count) + "☆".repeat(3 - count);
}

/** The best result of this browser. @param {string} file @returns {Result | null} */
export function bestOf(file) {
  try {
    return JSON.parse(localStorage.getItem(`guidewire best ${file}`) ?? "null");
  } catch {
    return null; // a browser that keeps nothing
  }
}

/** Keeps a result that is better than what was kept. @param {string} file @param {Result} result */
export function keepBest(file, result) {
  const best = bestOf(file);
  if (best && (best.stars > result.stars || (best.stars === result.stars && best.time <= result.time))) return;
  try {
    localStorage.setItem(`guidewire best ${file}`, JSON.stringify(result));
  } catch { /* as above */ }
}
