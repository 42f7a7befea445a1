// @ts-check
import { byId, make } from "./panel.js";

/**
 * Shows a card over the page, with a button for each answer. Escape answers nothing.
 * @param {string} title @param {Node[]} content @param {string[]} answers the last one is at hand
 * @returns {Promise<string>} the answer; empty for none
 */
export function ask(title, content, answers) {
  const card = byId("card");
  return new Promise((done) => {
    card.returnValue = "";
    card.onclose = () => done(card.returnValue);
    card.replaceChildren(make("h2", {}, title), ...content, make("p", { className: "tools" },
      ...answers.map((answer, k) => {
        const button = make("button", { onclick: () => card.close(answer) }, answer);
        button.autofocus = k === answers.length - 1;
        if (button.autofocus) button.classList.add("on");
        return button;
      })));
    if (!card.open) card.showModal();
  });
}
