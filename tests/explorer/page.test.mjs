// Every control of the page once, in a real browser; what is wrong ends in a sentence, and never in a blank page.

import assert from "node:assert/strict";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, afterEach, before, beforeEach, test } from "node:test";

import { drag, drawn, folder, inRoot, launch, openPage, placeOf, reprise, stateOf } from "./browser.mjs";

let browser;
let page;
before(async () => {
  browser = await launch();
});
beforeEach(async () => {
  page = await openPage(browser);
});
afterEach(async () => {
  assert.deepEqual(page.complaints, []);
  await page.close();
});
after(() => browser.close());

const value = (id) => page.locator(`#value-${id}`).getAttribute("data-value").then(Number);
const status = () => page.textContent("#status");
const choose = async (select, option) => {
  await page.selectOption(select, option);
  await drawn(page);
};
/** Moves a slider by the keyboard, as a user without a mouse does. */
const slide = async (id, key) => {
  await page.focus(id);
  await page.keyboard.press(key);
  await drawn(page);
};
const openFile = async (name, text) => {
  const file = join(folder, name);
  writeFileSync(file, text);
  await page.setInputFiles("#file", file);
  await page.waitForTimeout(100);
  await drawn(page);
};

test("every choice of what to show is shown", async () => {
  const options = await page.locator("#preset option").evaluateAll((all) => all.map((option) => option.value));
  assert.ok(options.length > 25);
  for (const option of options) {
    await choose("#preset", option);
    assert.equal(await page.inputValue("#preset"), option);
    assert.ok((await value("area")) > 0, option);
    assert.ok((await page.locator(".region").count()) > 0, option);
  }
});

test("a printed design is judged as the table prints it, and the reference is better", async () => {
  await choose("#preset", "printed 5.3 P2");
  const cell = (design, column) => page.locator(`tr[data-design="${design}"] td`).nth(column).getAttribute("data-value").then(Number);
  assert.ok(Math.abs((await cell("printed", 1)) - 0.927) < 5e-4);
  assert.ok((await cell("reference", 1)) > (await cell("printed", 1)));
  assert.ok(Math.abs(await cell("reference", 3)) < 1e-6);
  await page.click('tr[data-design="reference"] button');
  await drawn(page);
  assert.equal(await cell("shown now", 1), await cell("reference", 1));
});

test("handles are dragged, and one undo takes a drag back", async () => {
  await choose("#preset", "rectangle.toml");
  for (const [handle, part] of [["base-1", "problem"], ["platform-2", "problem"], ["point", "pose"], ["knob", "pose"],
    ["whole", "problem"], ["corner-1", "problem"]]) {
    const before = await stateOf(page);
    await drag(page, handle, 23, 17);
    const afterwards = await stateOf(page);
    assert.notDeepEqual(afterwards[part], before[part], handle);
    await page.click("#undo");
    await drawn(page);
    assert.deepEqual(await stateOf(page), before, handle);
    await page.click("#redo");
    await drawn(page);
    assert.deepEqual(await stateOf(page), afterwards, handle);
    await page.keyboard.press("Control+z");
    await drawn(page);
    assert.deepEqual(await stateOf(page), before, handle);
  }
});

test("a handle follows the pointer", async () => {
  for (const handle of ["base-1", "platform-1", "point"]) {
    await choose("#preset", "triangle.toml");
    const [x, y] = await placeOf(page, handle);
    await drag(page, handle, 31, -19);
    const [right, down] = await placeOf(page, handle);
    assert.ok(Math.hypot(right - x - 31, down - y + 19) < 1, handle);
  }
});

test("arrow keys move the chosen handle", async () => {
  await page.focus('[data-handle="point"]');
  const { pose } = await stateOf(page);
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("Shift+ArrowUp");
  await drawn(page);
  const moved = (await stateOf(page)).pose;
  assert.ok(moved.x > pose.x && moved.y > pose.y);
  assert.match(await page.getAttribute('[data-handle="point"]', "aria-label"), /Working point P, x .*, y .*arrow keys/);
});

test("the region of one's own is chosen, scaled and dragged", async () => {
  for (const region of ["none", "P1", "P3", "rectangle", "circle", "polygon"]) {
    await choose("#region", region);
    assert.equal(await page.inputValue("#region"), region);
    assert.equal(await page.isEnabled("#search"), region !== "none");
  }
  const before = await stateOf(page);
  await slide("#size", "ArrowRight");
  assert.ok((await stateOf(page)).problem.workspace.scale > (before.problem.workspace.scale ?? 1));
  // A corner dragged across the polygon: refused in a sentence, and the polygon stays one.
  await drag(page, "corner-1", 0, 260);
  assert.match(await status(), /workspace/);
  assert.ok((await value("area")) > 0);
});

test("one orientation, three and a range", async () => {
  const areas = {};
  for (const kind of ["SO", "MO", "D"]) {
    await page.check(`input[name=kind][value=${kind}]`);
    await drawn(page);
    areas[kind] = await value("area");
  }
  assert.ok(areas.D < areas.SO);
  await page.fill("#lower", "-2");
  await page.press("#lower", "Enter");
  await page.fill("#upper", "1");
  await page.press("#upper", "Enter");
  await drawn(page);
  assert.deepEqual((await stateOf(page)).range, [-2, 1]);
  assert.ok((await value("area")) > areas.D);
  await page.fill("#upper", "-7");
  await page.press("#upper", "Enter");
  await drawn(page);
  assert.match(await status(), /range/);
});

test("pose, assembly modes and leg limits", async () => {
  for (const [id, key] of [["#x", "x"], ["#y", "y"], ["#phi", "phi"]]) {
    await page.fill(id, "1.25");
    await page.press(id, "Enter");
    await drawn(page);
    assert.equal((await stateOf(page)).pose[key], 1.25);
  }
  await slide("#turn", "ArrowRight");
  assert.ok((await stateOf(page)).pose.phi > 1.25);
  const legs = await page.evaluate(() => explorer.documents.pose.legs);
  const modes = await page.locator("#modes button").count();
  for (let k = 0; k < modes; ++k) {
    await page.locator("#modes button").nth(k).click();
    await drawn(page);
    const there = await page.evaluate(() => explorer.documents.pose.legs);
    there.forEach((length, leg) => assert.ok(Math.abs(length - legs[leg]) < 1e-6));
  }
  for (const leg of [1, 2, 3]) {
    for (const end of ["min", "max"]) {
      const before = (await stateOf(page)).problem.manipulator.length[leg - 1];
      await slide(`#leg-${leg}-${end}`, "ArrowRight");
      assert.notDeepEqual((await stateOf(page)).problem.manipulator.length[leg - 1], before);
    }
  }
  await page.click("#free");
  await drawn(page);
  assert.equal((await stateOf(page)).problem.manipulator.leg.length, 3);
});

test("a search is stopped, and one to the end is replayed", async () => {
  await choose("#formulation", "area");
  // At once: a search may take no longer than a click.
  await page.evaluate(() => ["search", "stop"].forEach((id) => document.getElementById(id).click()));
  assert.match(await page.textContent("#outcome"), /Stopped/);
  await choose("#formulation", "pointwise");
  await choose("#region", "rectangle");
  await page.click("#search");
  await page.waitForFunction(() => explorer.found);
  await drawn(page);
  assert.match(await page.textContent("#outcome"), /^Found/);
  assert.ok((await value("g")) < 1e-5);
  const found = await stateOf(page);
  await slide("#iterate", "Home");
  assert.notDeepEqual((await stateOf(page)).problem, found.problem);
  await page.click('tr[data-design="found"] button');
  await drawn(page);
  assert.deepEqual((await stateOf(page)).problem, found.problem);
  assert.ok((await page.locator("#convergence path").count()) === 2);
});

test("a region that no design reaches ends in a sentence", async () => {
  await choose("#region", "rectangle");
  await page.fill("#size", "3");
  await page.evaluate(() => document.getElementById("size").dispatchEvent(new Event("change")));
  await page.click("#search");
  await page.waitForFunction(() => explorer.found || /No design/.test(document.getElementById("outcome").textContent), undefined, { timeout: 60_000 });
  assert.match(await page.textContent("#outcome"), /^No design that reaches/);
});

test("layers, zoom and the value under the pointer", async () => {
  const shown = () => page.evaluate(() => [...document.querySelectorAll(".singular, .corner")].length);
  const before = await shown();
  for (const layer of ["map", "contours", "singular", "corners"]) {
    await page.uncheck(`#show-${layer}`);
    await drawn(page);
  }
  assert.ok(before > 0);
  assert.equal(await shown(), 0);
  const scale = () => page.evaluate(() => explorer.view.scale);
  const first = await scale();
  await page.click("#closer");
  assert.ok((await scale()) > first);
  await page.click("#farther");
  await page.click("#farther");
  assert.ok((await scale()) < first);
  await page.click("#fit");
  assert.ok(Math.abs((await scale()) - first) < 1e-9 * first);
  const stage = await page.locator("#stage").boundingBox();
  await page.mouse.move(stage.x + 40, stage.y + 40);
  await page.mouse.wheel(0, -200);
  assert.ok((await scale()) > first);
  assert.match(await page.textContent("#pointer"), /x .*, y .*: κ⁻¹ /);
});

test("a saved file is read by reprise, with the same area", async () => {
  for (const preset of ["P2.toml", "P3_dextrous.toml", "rectangle.toml", "gosselin_jean.toml"]) {
    await choose("#preset", preset);
    await drag(page, "base-1", -9, 4);
    const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
    const toml = readFileSync(await download.path(), "utf8");
    const { kind, range, pose } = await stateOf(page);
    const native = kind === "D" ? reprise("dextrous", toml, `--range=${range[0]}`, range[1]) : reprise("workspace", toml, `--orientation=${pose.phi}`);
    assert.ok(Math.abs(native.area - (await value("area"))) < 1e-9 * native.area, preset);
    // And back: the file is what was shown.
    const before = await stateOf(page);
    await openFile("saved.toml", toml);
    assert.deepEqual((await stateOf(page)).problem, before.problem);
  }
});

test("a link holds the state", async () => {
  await choose("#preset", "rectangle.toml");
  await drag(page, "point", 12, 9);
  await page.click("#link");
  await page.waitForFunction(() => location.hash.length > 20);
  await page.waitForTimeout(500);
  const hash = await page.evaluate(() => location.hash);
  const other = await openPage(browser, { hash });
  assert.deepEqual(await stateOf(other), await stateOf(page));
  assert.deepEqual(other.complaints, []);
  await other.close();
  const spoilt = await openPage(browser, { hash: "#nothing" });
  assert.ok(await spoilt.evaluate(() => explorer.documents.workspace.area > 0));
  await spoilt.close();
});

test("bad files are refused in a sentence, and what was shown stays", async () => {
  const before = await stateOf(page);
  const corpus = inRoot("tests", "apps", "corpus");
  const files = readdirSync(corpus).filter((name) => name.endsWith(".toml")).map((name) => [name, readFileSync(join(corpus, name), "utf8")]);
  const broken = [["empty.toml", ""], ["text.toml", "no TOML"], ["key.toml", '[manipulator]\nname = "a"\nlegs = 3\n'],
    ["lost.toml", '[manipulator]\nfile = "nowhere.toml"\n'], ["binary.toml", "\0\u0001\u0002"], ["long.toml", "#".repeat(1_100_000)]];
  for (const [name, text] of broken) {
    await openFile(name, text);
    assert.match(await status(), /\.toml.*\.$/s, name);
    assert.deepEqual(await stateOf(page), before, name);
  }
  for (const [name, text] of files) {
    await openFile(name, text);
    assert.ok((await status()).length > 10, name);
    assert.ok(await page.evaluate(() => document.querySelectorAll(".handle").length > 4), name);
  }
});

test("the page fits a telephone, in the light and in the dark", async () => {
  for (const dark of [false, true]) {
    const small = await openPage(browser, { width: 390, height: 844, dark });
    const width = await small.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(width <= 390, `${width} pixels wide`);
    assert.deepEqual(small.complaints, []);
    await small.close();
  }
});
