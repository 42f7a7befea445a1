// Watches the page of a live scene under keys, and prints as JSON how many pictures each view drew, what they cost, and
// how long keys took to be seen. Arguments: a folder that finds playwright-core, the browser, the page's address,
// seconds, the views that are shown ("both", "xray" or "space").
import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [modules, executablePath, address, seconds, views] = process.argv.slice(2);
const { chromium } = createRequire(`${modules}/`)("playwright-core");
const mark = `guidewire-${process.pid}`;
const browser = await chromium.launch({
  executablePath, args: ["--no-sandbox", "--enable-unsafe-swiftshader", `--user-agent=${mark}`],
});
const page = await browser.newPage({ viewport: { width: 1000, height: 640 } });
await page.goto(address);
while (!await page.evaluate("globalThis.viewer?.stage.drawn > 0")) await page.waitForTimeout(50);

/** ms of processor time of the browser's processes, where /proc says so. */
const processor = () => {
  let ticks = 0;
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      if (!readFileSync(`/proc/${id}/cmdline`, "utf8").includes(mark)) continue;
      const fields = readFileSync(`/proc/${id}/stat`, "utf8").split(") ").at(-1).split(" ");
      ticks += Number(fields[11]) + Number(fields[12]);
    } catch { /* it has ended */ }
  }
  return 10 * ticks;
};
const look = async () => [...await page.evaluate("[viewer.stage.drawn, viewer.xray.drawn, performance.now()]"),
  processor()];

await page.evaluate("document.activeElement.blur()");
await page.evaluate(`document.querySelector("button[data-views=${views}]").click()`);
await page.keyboard.down("w");
await page.waitForTimeout(1500);
const before = await look();
for (let k = 0; k < 2 * seconds; k++) {
  await page.waitForTimeout(500);
  await page.keyboard.press(k % 2 ? "d" : "a");
}
const after = await look();
const [space, xray, milliseconds, work] = after.map((value, k) => value - before[k]);
const pictures = { space, xray, both: Math.min(space, xray) }[views];
const delays = (await page.evaluate("viewer.shown.delays")).sort((a, b) => a - b);
console.log(JSON.stringify({
  rate: (1000 * pictures) / milliseconds, cost: work / pictures, median: delays[delays.length >> 1],
  worst: delays.at(-1), keys: delays.length,
}));
await browser.close();
