// What the page shows is what the libraries compute natively.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";

import { drawn, launch, natively, openPage, reprise } from "./browser.mjs";

const tolerance = 1e-9;
let browser;
let page;
before(async () => {
  browser = await launch();
  page = await openPage(browser);
});
after(() => browser.close());

/** Numbers from 0 to 1, the same ones in every run: a linear congruence modulo 2^32. */
function numbers(seed) {
  let state = seed;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Like assert.equal, for numbers, lists and objects of them, within a tolerance that grows with the numbers. */
function assertNear(page, native, where, within = tolerance) {
  if (typeof native === "number") {
    assert.ok(Math.abs(page - native) <= within * Math.max(1, Math.abs(native)), `${where}: ${page} for ${native}`);
  } else if (native !== null && typeof native === "object") {
    assert.deepEqual(Object.keys(page), Object.keys(native), where);
    for (const key of Object.keys(native)) assertNear(page[key], native[key], `${where}.${key}`, within);
  } else {
    assert.equal(page, native, where);
  }
}

/** Shows one of the examples with joints, lengths, pose and range moved at random; returns what the page shows. */
async function show(preset, random) {
  return page.evaluate(async ([name, parts]) => {
    const moved = (value, size) => value + size * (parts.pop() - 0.5);
    const problem = structuredClone(explorer.presets.problem(name));
    const { manipulator } = problem;
    const unit = Math.max(...(manipulator.length ?? manipulator.leg.map(({ length }) => length)).flat()) / 2;
    if (manipulator.design) {
      manipulator.design = manipulator.design.map((value) => moved(value, 0.2 * unit));
    } else {
      for (const leg of manipulator.leg) {
        leg.base = leg.base.map((value) => moved(value, 0.2 * unit));
        leg.platform = leg.platform.map((value) => moved(value, 0.1 * unit));
      }
      delete problem.design?.bounds;
    }
    const state = explorer.stateOf(problem, "");
    state.pose = { x: moved(state.pose.x, 0.3 * unit), y: moved(state.pose.y, 0.3 * unit), phi: moved(state.pose.phi, 20) };
    state.kind = ["SO", "MO", "D"][Math.floor(3 * parts.pop())];
    const width = 1 + 9 * parts.pop();
    state.range = [state.pose.phi - width, state.pose.phi + width];
    explorer.begin(state);
    const value = (id) => (document.getElementById(`value-${id}`).dataset.value === "" ? null : Number(document.getElementById(`value-${id}`).dataset.value));
    return {
      toml: explorer.text(),
      state: explorer.store.state,
      documents: { ...explorer.documents, lengths: manipulator.length ?? manipulator.leg.map(({ length }) => length) },
      values: { area: value("area"), kappa: value("kappa"), f: value("f"), g: value("g") },
    };
  }, [preset, Array.from({ length: 60 }, random)]);
}

test("50 states have the areas, kappa^-1, f, g and assembly modes of the native libraries", async () => {
  const presets = ["P1.toml", "P2.toml", "P3.toml", "P2_several.toml", "P3_dextrous.toml", "triangle.toml", "circle.toml",
    "rectangle.toml", "polygon.toml", "gosselin_jean.toml"];
  const random = numbers(18);
  for (let k = 0; k < 50; ++k) {
    const { toml, state, documents, values } = await show(presets[k % presets.length], random);
    const where = `state ${k}, ${presets[k % presets.length]}`;
    const { x, y, phi } = state.pose;
    const pose = reprise("pose", toml, `--at=${x}`, y, `--orientation=${phi}`);
    const workspace = state.kind === "D"
      ? reprise("dextrous", toml, `--range=${state.range[0]}`, state.range[1])
      : reprise("workspace", toml, `--orientation=${phi}`);
    assertNear(values.area, workspace.area, `${where}: area`, tolerance);
    assertNear(documents.workspace.components.map(({ area }) => area), workspace.components.map(({ area }) => area), where);
    assertNear(values.kappa, pose.kappa_inv, `${where}: kappa^-1`);
    assertNear(documents.pose.legs, pose.legs, `${where}: legs`);
    assertNear(documents.orientation.intervals_deg, reprise("orientation", toml, `--at=${x}`, y).intervals_deg, where, 1e-6);
    if (pose.legs.length === 3) {
      const modes = reprise("assemble", toml, "--lengths", ...documents.pose.legs);
      assertNear(documents.modes.modes, modes.modes, `${where}: modes`, 1e-8);
    }
    if (values.f !== null || state.problem.workspace) {
      const [{ answers: [design] }] = natively([{ toml, questions: [{ command: "design" }] }]);
      assertNear(values.f, design.kappa_inv, `${where}: f`);
      // An area by the chord method, whose last chord depends on the first; half of the longest leg is 1 there.
      const half = Math.max(...documents.lengths.flat()) / 2;
      assertNear(values.g / half ** 2, design.constraint / half ** 2, `${where}: g`, 1e-8);
    }
  }
  assert.deepEqual(page.complaints, []);
});

/** Searches in the page, and natively. */
async function searchBoth(preset, formulation) {
  await page.selectOption("#preset", preset);
  await page.selectOption("#formulation", formulation);
  await drawn(page);
  const toml = await page.evaluate(() => explorer.text());
  await page.click("#search");
  await page.waitForFunction(() => explorer.found, undefined, { timeout: 120_000 });
  const [native] = natively([{ toml, formulation }]);
  return [await page.evaluate(() => explorer.found), native];
}

test("searches end where they end natively, after as many gradients", async () => {
  for (const preset of ["P1", "P2", "P3", "P1_several", "P2_several", "P3_several", "P1_dextrous", "P2_dextrous"]) {
    const [found, native] = await searchBoth(`${preset}.toml`, "pointwise");
    assert.equal(found.status, native.status, preset);
    assert.equal(found.gradient_evaluations, native.gradient_evaluations, `${preset}: N^g`);
    assertNear(found.kappa_inv, native.kappa_inv, `${preset}: f`, 1e-6);
    assertNear(found.design, native.design, `${preset}: design`, 1e-6);
  }
  assert.deepEqual(page.complaints, []);
});

// Where a search stops depends on rounding when its functions are not smooth, as in the thesis's formulation, or when its
// way is long; and the page has another sine.
test("other searches end at a design that is as good", async () => {
  for (const [preset, formulation] of [["P1", "area"], ["P2", "area"], ["P3", "area"], ["rectangle", "pointwise"]]) {
    const [found, native] = await searchBoth(`${preset}.toml`, formulation);
    assert.equal(found.status, native.status, preset);
    assertNear(found.kappa_inv, native.kappa_inv, `${preset}: f`, 5e-3);
    const longest = Math.max(...(found.manipulator.length ?? found.manipulator.leg.map(({ length }) => length)).flat());
    assert.ok(found.violation < 1e-3 * longest, `${preset}: violation ${found.violation}`);
  }
  assert.deepEqual(page.complaints, []);
});

test("expressions are worth what they are worth natively", async () => {
  const expressions = ["10*sqrt(3)/3", "-5*sqrt(3)", "pi/6", "1/3/3", "1 - 2 - 3", "2 + 3 * 4", "(2 + 3) * -4", "-(-2)",
    " .5 ", "+5.", "15.91e-1", "0.1*3", "sqrt(sqrt(16) + 12)", "2*cos(120)", "2*sin(120)", "sin(180)", "007", "1/0.05"];
  const seen = await page.evaluate((all) => all.map((text) => explorer.engine.read("numbers.toml",
    `[manipulator]\nname = "n"\ndesign = ["${text}", 0, 1, 2, 1]\nlength = [[1, 2], [1, 2], [1, 2]]\n`).manipulator.design[0]), expressions);
  const native = natively(expressions.map((text) => ({
    toml: `[manipulator]\nname = "n"\ndesign = ["${text}", 0, 1, 2, 1]\nlength = [[1, 2], [1, 2], [1, 2]]\n`,
    questions: [{ command: "problem" }],
  })));
  native.forEach(({ answers }, k) => assertNear(seen[k], answers[0].manipulator.design[0], expressions[k], 4e-16));
  const refused = await page.evaluate((all) => all.map((text) => {
    try {
      explorer.engine.read("numbers.toml", `[manipulator]\nname = "n"\ndesign = ["${text}", 0, 1, 2, 1]\nlength = [[1, 2], [1, 2], [1, 2]]\n`);
      return "";
    } catch (error) {
      return error.message;
    }
  }), ["", "2*", "2**3", "1//2", "2pi", "alert(1)", "explorer", "0x10", "1_000", "1/0", "sqrt(-1)", "a=1", "--5", "1 2"]);
  for (const sentence of refused) assert.match(sentence, /^numbers\.toml, line 3: .*expression may have/);
});
