// What the tests of the explorer share: the page in Debian's Chromium, and the same questions asked natively.

import { execFileSync } from "node:child_process";
import { createRequire } from "node:module";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
const { chromium } = createRequire(join(root, "build", "explorer-tests", "package.json"))("playwright-core");

/** A folder for the files of a test. */
export const folder = mkdtempSync(join(tmpdir(), "explorer-"));

/** A path of the repository. */
export const inRoot = (...path) => join(root, ...path);

export function launch() {
  return chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox"] });
}

/**
 * The page, ready. Whatever the console says of errors is kept in `complaints`.
 * @param {{hash?: string, width?: number, height?: number, dark?: boolean}} [options]
 */
export async function openPage(browser, { hash = "", width = 1280, height = 900, dark = false } = {}) {
  const page = await browser.newPage({
    viewport: { width, height },
    colorScheme: dark ? "dark" : "light",
    acceptDownloads: true,
    reducedMotion: "reduce",
  });
  page.complaints = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  await page.goto(pathToFileURL(inRoot("build", "explorer", "index.html")).href + hash);
  await page.waitForFunction(() => globalThis.explorer?.documents);
  return page;
}

/** Waits until what was asked for is drawn. */
export async function drawn(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
}

/** What `reprise` answers about a problem file's text. */
export function reprise(command, toml, ...options) {
  const file = join(folder, "state.toml");
  writeFileSync(file, toml);
  return JSON.parse(execFileSync(inRoot("build", "bin", "reprise"), [command, file, ...options.map(String), "--json"], { encoding: "utf8" }));
}

/** What the page's own C++ answers natively: replies to requests, each about a file with its text. */
export function natively(requests) {
  const lines = requests.map(({ toml, ...rest }, k) => {
    const file = join(folder, `request-${k}.toml`);
    writeFileSync(file, toml);
    return JSON.stringify({ file, ...rest });
  });
  const input = `${lines.join("\n")}\n`;
  const program = inRoot("build", "release", "apps", "explorer", "explorer_answers");
  return execFileSync(program, { input, encoding: "utf8", maxBuffer: 1e9 }).trim().split("\n").map((line) => JSON.parse(line));
}

/** The middle of a handle, in pixels of the page. */
export async function placeOf(page, handle) {
  const box = await page.locator(`[data-handle="${handle}"] .mark`).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}

/** Drags a handle by so many pixels. */
export async function drag(page, handle, right, down) {
  const [x, y] = await placeOf(page, handle);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (let k = 1; k <= 5; ++k) await page.mouse.move(x + (right * k) / 5, y + (down * k) / 5);
  await page.mouse.up();
  await drawn(page);
}

/** What the page shows, as its own state. */
export const stateOf = (page) => page.evaluate(() => explorer.store.state);
