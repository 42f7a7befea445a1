// Drives a browser for the tests: a JSON list of orders a line on standard input, a JSON list of what was seen a line
// on standard output. Arguments: a folder that finds playwright-core, and the browser.
import { createRequire } from "node:module";
import { createInterface } from "node:readline";

const [modules, executablePath] = process.argv.slice(2);
const require = createRequire(`${modules}/`);
const { chromium } = require("playwright-core");
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });

const until = async (page, expression) => {
  for (let k = 0; k < 2400; k++) {
    if (await page.evaluate(expression)) return;
    await page.waitForTimeout(50);
  }
  throw new Error(`not within 2 minutes: ${expression}`);
};
// Menus that hold it are opened.
const reveal = async (locator) => {
  await locator.evaluate((one) => {
    for (let menu = one.closest("details"); menu; menu = menu.parentElement.closest("details")) menu.open = true;
  });
  return locator;
};
// A selector, or a role and a part of a name of the accessibility tree.
const locate = (page, what) => (typeof what === "string" ? page.locator(what)
  : page.getByRole(what.role, { name: new RegExp(what.name) }).first());
const protocols = new WeakMap();
const protocol = async (page) => {
  if (!protocols.has(page)) protocols.set(page, await page.context().newCDPSession(page));
  return protocols.get(page);
};
const orders = {
  init: (page, script) => page.addInitScript(script),
  open: (page, address) => page.goto(address),
  until,
  down: (page, key) => page.keyboard.down(key),
  up: (page, key) => page.keyboard.up(key),
  press: (page, key) => page.keyboard.press(key),
  choose: async (page, [selector, value]) => void await (await reveal(page.locator(selector))).selectOption(value),
  click: async (page, name) => (await reveal(page.getByRole("button", { name, exact: true, includeHidden: true }).first())).click(),
  // A finger: where in an element, from 0 to 1 across and down; without a place it is lifted.
  touch: async (page, [selector, across, down]) => {
    const isDown = across !== undefined;
    const element = locate(page, selector);
    let box = isDown && await element.boundingBox();
    for (let k = 0; k < 2400 && box === null; k++) { // it has no place while the page draws it anew
      await page.waitForTimeout(50);
      box = await element.boundingBox();
    }
    await (await protocol(page)).send("Input.dispatchTouchEvent", { type: isDown ? "touchStart" : "touchEnd",
      touchPoints: isDown ? [{ x: box.x + across * box.width, y: box.y + down * box.height }] : [] });
  },
  drop: async (page, files) => {
    for (const type of ["dragEnter", "dragOver", "drop"]) {
      await (await protocol(page)).send("Input.dispatchDragEvent",
        { type, x: 100, y: 100, data: { items: [], files, dragOperationsMask: 1 } });
    }
  },
  // Waits until the accessibility tree has a text.
  said: async (page, text) => {
    for (let k = 0; k < 1200; k++) {
      if (new RegExp(text, "i").test(await page.locator("body").ariaSnapshot())) return;
      await page.waitForTimeout(100);
    }
    throw new Error(`not within 2 minutes in the accessibility tree: ${text}`);
  },
  see: (page, expression) => page.evaluate(expression),
  back: (page) => page.goBack(),
  // What axe finds that keeps people out: rule, and the elements.
  axe: async (page) => {
    if (!await page.evaluate("'axe' in globalThis")) await page.evaluate(require("axe-core").source);
    const { violations } = await page.evaluate("axe.run({ resultTypes: ['violations'] })");
    return violations.filter(({ impact }) => ["critical", "serious"].includes(impact))
      .map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 90)).join(" ")}`);
  },
  picture: async (page, path) => void await page.screenshot({ path }),
};

for await (const line of createInterface({ input: process.stdin })) {
  const { offline, size, steps } = JSON.parse(line);
  const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, offline });
  context.setDefaultTimeout(120_000);
  // A processor draws here what a graphics card draws elsewhere: 7 pictures a second are enough to test.
  await context.addInitScript(() => {
    const next = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (draw) => setTimeout(() => next(draw), 130);
  });
  const page = await context.newPage();
  const troubles = [];
  const asked = [];
  page.on("pageerror", (error) => troubles.push(error.message));
  page.on("console", (message) => message.type() === "error" && troubles.push(message.text()));
  page.on("request", (request) => asked.push(request.url()));
  const seen = [];
  try {
    for (const [order, value] of steps) {
      const answer = await orders[order](page, value);
      if (order === "see" || order === "axe") seen.push(answer);
    }
  } catch (error) {
    troubles.push(error.message);
  }
  process.stdout.write(`${JSON.stringify({ seen, troubles, asked })}\n`);
  await context.close();
}
await browser.close();
