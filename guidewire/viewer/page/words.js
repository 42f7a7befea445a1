// @ts-check
/** The page's texts in other languages: words/de.json and its like, from the English text to the other one. */

/** Languages by how they call themselves; English is what the page is written in. */
export const LANGUAGES = { en: "English", de: "Deutsch", fr: "Français" };
const KEPT = "guidewire language";

/** @type {Record<string, string>} */
let words = {};
/** Of the page, as of LANGUAGES. */
export let language = "en";

/** A text of the page in its language. @param {string} text with {0} where the first value stands, and so on
 * @param {...(string | number)} values */
export function say(text, ...values) {
  return values.reduce((/** @type {string} */ said, value, k) => said.replaceAll(`{${k}}`, String(value)), words[text] ?? text);
}

/** A number as it is written in the page's language. @param {number} value @param {number} digits behind the point */
export function fixed(value, digits) {
  if (!Number.isFinite(value)) return "–";
  return value.toLocaleString(language, { minimumFractionDigits: digits, maximumFractionDigits: digits, useGrouping: false });
}

/** Puts the page's frame into the language that was chosen, or into the browser's. */
export async function translate() {
  const kept = (() => {
    try {
      return localStorage.getItem(KEPT);
    } catch {
      return null; // a browser that keeps nothing
    }
  })();
  const asked = [kept, ...navigator.languages].map((one) => one?.slice(0, 2) ?? "").find((one) => one in LANGUAGES) ?? "en";
  const packed = /** @type {any} */ (globalThis).guidewireWords?.[`words/${asked}.json`];
  try {
    if (asked !== "en") words = packed ? JSON.parse(packed) : await (await fetch(`words/${asked}.json`)).json();
    language = asked;
  } catch {
    return; // without its words the page stays English
  }
  document.documentElement.lang = language;
  const nodes = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (nodes.nextNode()) {
    const { currentNode: node } = nodes;
    const text = node.textContent?.trim() ?? "";
    if (text in words) node.textContent = /** @type {string} */ (node.textContent).replace(text, words[text]);
  }
  for (const one of document.querySelectorAll("[aria-label], [title]")) {
    for (const name of ["aria-label", "title"]) {
      if (one.hasAttribute(name)) one.setAttribute(name, say(/** @type {string} */ (one.getAttribute(name))));
    }
  }
}

/** @param {string} chosen of LANGUAGES; the page begins anew in it */
export function choose(chosen) {
  localStorage.setItem(KEPT, chosen);
  location.reload();
}
