// node tests/explorer/benchmark.mjs TABLE
// How long a frame takes while something is dragged, in Debian's Chromium without a screen: 200 frames for each handle,
// everything shown. A frame is the page's own work, from the state to the drawing; between frames lies what passes from
// one to the next, with the browser's layout and painting.

import { mkdirSync, writeFileSync } from "node:fs";
import { cpus } from "node:os";
import { dirname } from "node:path";

import { launch, openPage, placeOf } from "./browser.mjs";

const frames = 200;
const [table] = process.argv.slice(2);
const median = (values) => [...values].sort((one, other) => one - other)[Math.floor(values.length / 2)];

const browser = await launch();
const lines = [
  "# A frame of the explorer while something is dragged",
  `# ${cpus()[0].model}, Chromium ${browser.version()}, 1280 x 900 pixels, ${frames} frames each`,
  "# preset [-]: what is shown",
  "# handle [-]: what is dragged",
  "# work_ms [ms]: median of the page's own work for a frame",
  "# frame_ms [ms]: median of the time from frame to frame",
  "# first_paint_ms [ms]: from the navigation to the first contentful paint",
  "preset,handle,work_ms,frame_ms,first_paint_ms",
];
for (const [preset, handle] of [["P2.toml", "base-1"], ["P2.toml", "point"], ["P2_dextrous.toml", "base-1"], ["triangle.toml", "platform-2"], ["rectangle.toml", "corner-1"]]) {
  const page = await openPage(browser);
  const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0].startTime);
  await page.selectOption("#preset", preset);
  await page.waitForTimeout(300);
  await page.evaluate(() => {
    globalThis.work = [];
    globalThis.between = [];
    const draw = explorer.drawNow.bind(explorer);
    explorer.drawNow = () => {
      const begin = performance.now();
      draw();
      work.push(performance.now() - begin);
    };
    let last = 0;
    const note = (now) => {
      between.push(now - last);
      last = now;
      requestAnimationFrame(note);
    };
    requestAnimationFrame(note);
  });
  const [x, y] = await placeOf(page, handle);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 0; await page.evaluate(() => work.length) < frames; ++k) {
    await page.mouse.move(x + 12 * Math.sin(k / 9), y + 12 * Math.sin(k / 13));
  }
  await page.mouse.up();
  const [work, between] = await page.evaluate(() => [globalThis.work, globalThis.between]);
  lines.push([preset, handle, median(work).toFixed(2), median(between).toFixed(2), paint.toFixed(0)].join(","));
  console.log(lines.at(-1));
  await page.close();
}
await browser.close();
mkdirSync(dirname(table), { recursive: true });
writeFileSync(table, `${lines.join("\n")}\n`);
