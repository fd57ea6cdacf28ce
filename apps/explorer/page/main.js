// The page: state, libraries and drawing put together.

import { KappaMap } from "./map.js";
import { palette } from "./colours.js";
import { drawConvergence } from "./convergence.js";
import { Designs } from "./designs.js";
import { Engine, unpackCode } from "./engine.js";
import { handlesOf, listen } from "./handles.js";
import { fromHash, toHash } from "./link.js";
import { legsOf } from "./manipulator.js";
import { Panel, short, withOrientations } from "./panel.js";
import { kindOf } from "./prescribed.js";
import { Presets } from "./presets.js";
import { componentPath } from "./region.js";
import { Scene } from "./scene.js";
import { Search } from "./search.js";
import { Store } from "./store.js";
import { toToml } from "./toml.js";
import { boxAbout, View } from "./view.js";

const byId = (id) => document.getElementById(id);
const firstPreset = "P2.toml";

class Page {
  view = new View();
  scene = new Scene(byId("scene"));
  map = new KappaMap(byId("map"));
  store = new Store((_, change) => this.changed(change));
  found = null;
  documents = null;
  held = null;
  #frame = 0;
  #settled = true;
  #good = null;
  #judged = "";
  #outlined = { workspace: null, points: [] };
  /** What the libraries refused last, until something else is shown. */
  #refusal = { state: null, sentence: "" };

  async start() {
    const data = JSON.parse(byId("data").textContent);
    const code = await unpackCode(byId("engine").textContent);
    this.engine = await Engine.start(code, data.examples);
    this.presets = new Presets(data, this.engine);
    this.presets.fill(byId("preset"));
    this.panel = new Panel({ store: this.store, presets: this.presets, own: () => this.ownRegion() });
    this.designs = new Designs(byId("designs"), this.engine, (manipulator) => {
      this.store.change({ problem: { ...this.store.state.problem, manipulator } });
    });
    this.search = new Search(code, byId("worker").textContent, {
      iterate: (index) => this.showIterate(index),
      ended: (found, sentence) => this.searchEnded(found, sentence),
    });
    this.listen();
    this.drawLegend();
    this.measure();
    const linked = await fromHash(location.hash);
    if (linked) this.begin(linked);
    else this.choose(firstPreset);
  }

  /** The state for a problem that has just been chosen. */
  stateOf(problem, preset) {
    const { kind, range } = kindOf(problem.orientations);
    const phi = kind === "SO" ? (problem.orientations?.slices_deg[0] ?? 0) : (range[0] + range[1]) / 2;
    const [x, y] = problem.workspace?.centre ?? this.inside(problem, phi);
    return { problem, pose: { x, y, phi }, kind, range, preset, base: problem.workspace?.scale ?? 1 };
  }

  /** A position in the largest part of the workspace, that above where there are two of the same size. */
  inside(problem, phi) {
    const [{ components }] = this.engine.ask(problem, [{ command: "workspace", orientation_deg: phi }]);
    const large = components.filter(({ area }) => area > 0.99 * components[0].area);
    const boxes = large.map(({ boundary }) => boxAbout(boundary)).sort((one, other) => other.top - one.top);
    if (boxes.length === 0) return legsOf(problem.manipulator)[0].base;
    const { left, right, bottom, top } = boxes[0];
    return [(left + right) / 2, (bottom + top) / 2].map((value) => Number(value.toPrecision(3)));
  }

  /** Where a region of one's own goes. */
  ownRegion() {
    const { problem, pose } = this.store.state;
    const longest = Math.max(...legsOf(problem.manipulator).map(({ length }) => length[1]));
    const centre = problem.workspace?.centre ?? [pose.x, pose.y];
    return { centre, size: Number((0.15 * longest).toPrecision(2)) };
  }

  choose(preset) {
    try {
      this.begin(this.stateOf(this.presets.problem(preset), preset));
    } catch (error) {
      this.say(error.message, true);
    }
  }

  /** Shows a state without a past; the libraries may refuse it. */
  begin(state) {
    try {
      this.ask(withOrientations(state));
    } catch (error) {
      this.say(error.message, true);
      if (!this.store.state) this.choose(firstPreset);
      return;
    }
    this.search.stop();
    byId("stop").disabled = true;
    this.found = null;
    this.search.history = [];
    this.showReplay(0);
    byId("outcome").textContent = outcomeAtFirst;
    byId("preset").value = state.preset;
    this.store.begin(state);
    this.panel.fitSliders();
    this.drawNow();
    this.fit();
  }

  /** Documents about a state. Throws where the libraries refuse it. */
  ask(state) {
    const { problem, pose, kind, range } = state;
    const position = [pose.x, pose.y];
    const orientation_deg = pose.phi;
    const box = this.view.box;
    const [shownPose, workspace, singular, design, orientation] = this.engine.ask(problem, [
      { command: "pose", position, orientation_deg },
      kind === "D" ? { command: "dextrous", range_deg: range } : { command: "workspace", orientation_deg },
      { command: "singular", orientation_deg, box: [[box.left, box.bottom], [box.right, box.top]] },
      { command: "design" },
      { command: "orientation", position },
    ]);
    const modes = problem.manipulator.leg && problem.manipulator.leg.length !== 3
      ? { modes: [] }
      : this.engine.ask(problem, [{ command: "assemble", lengths: shownPose.legs }])[0];
    return { pose: shownPose, workspace, outline: this.outlineOf(problem), curves: singular.curves, design, orientation, modes };
  }

  /** Points of the prescribed workspace; found once for each, since tables are never changed. */
  outlineOf(problem) {
    if (!problem.workspace) return [];
    if (this.#outlined.workspace !== problem.workspace) {
      const [{ points }] = this.engine.ask(problem, [{ command: "outline" }]);
      this.#outlined = { workspace: problem.workspace, points };
    }
    return this.#outlined.points;
  }

  /** A change of the state: it is drawn with the next frame. */
  changed({ settled }) {
    this.#settled = settled;
    if (this.#frame === 0) {
      this.#frame = requestAnimationFrame(() => {
        this.#frame = 0;
        this.drawNow();
      });
    }
  }

  redraw() {
    this.changed({ settled: this.#settled });
  }

  /** The orientations that kappa^-1 is the least over. */
  get shownRange() {
    const { kind, pose, range } = this.store.state;
    return kind === "D" ? range : [pose.phi, pose.phi];
  }

  get layers() {
    const wanted = (name) => byId(`show-${name}`).checked;
    return { map: wanted("map"), contours: wanted("contours"), singular: wanted("singular"), corners: wanted("corners") };
  }

  drawNow() {
    const state = withOrientations(this.store.state);
    try {
      this.documents = this.ask(state);
      this.#good = this.store.state;
    } catch (error) {
      this.say(error.message, true);
      if (!this.#good || this.store.state === this.#good) return;
      this.#refusal = { state: this.#good, sentence: error.message };
      this.store.restore(this.#good);
      this.drawNow();
      return;
    }
    this.engine.show();
    const { view } = this;
    const { workspace, outline, curves, pose } = this.documents;
    const layers = this.layers;
    this.handles = handlesOf(state, view, outline).map((handle) => ({ ...handle, value: this.valueText(handle, state) }));
    const shapes = workspace.components.map((component) => ({ component, path: componentPath(component, view) }));
    const ends = this.map.draw(this.engine, view, shapes, this.shownRange, layers);
    const corners = workspace.components.flatMap((component) => component.bifurcation_points);
    this.scene.draw({ state, view, handles: this.handles, shapes, pose, outline, curves, corners, layers, held: this.held });
    this.panel.show(state, this.documents);
    byId("lowest").textContent = ends ? short(ends[0], 2) : "";
    byId("highest").textContent = ends ? short(ends[1], 2) : "";
    const refused = this.store.state === this.#refusal.state;
    if (!refused) this.#refusal.state = null;
    this.say(refused ? this.#refusal.sentence : this.sentence(), refused || !pose.within_limits);
    if (this.#settled) this.settle(state);
  }

  /** What can wait until nothing is dragged any more. */
  settle(state) {
    const judged = toToml(state.problem) + (this.found ? JSON.stringify(this.found.design) : "");
    if (judged !== this.#judged) {
      this.#judged = judged;
      this.designs.show(state.problem, { found: this.found, row: this.presets.row(state.problem) });
    }
    clearTimeout(this.linking);
    this.linking = setTimeout(async () => history.replaceState(null, "", `#${await toHash(this.store.state)}`), 300);
  }

  valueText({ id, at }, state) {
    return id === "knob" ? `${short(state.pose.phi, 4)} degrees` : `x ${short(at[0], 4)}, y ${short(at[1], 4)}`;
  }

  /** What there is to say about the pose and the region. */
  sentence() {
    const { pose, design, workspace } = this.documents;
    const broken = pose.limits.filter(({ holds }) => !holds);
    if (broken.length > 0) {
      const [{ limit, margin }] = [...broken].sort((one, other) => one.margin - other.margin);
      return `This pose cannot be attained: the limit ${limit}, is missed by ${short(-margin, 3)}.`;
    }
    if (pose.singular) return "This pose is singular: the legs cannot hold every force there.";
    if (workspace.components.length === 0) return "The workspace is empty.";
    if (design.constraint === undefined) return "Choose a region to reach, and let the search find the best design for it.";
    if (design.constraint > 1e-5) return `The region is not reached: an area of ${short(design.constraint, 3)} sticks out.`;
    return `The whole region is reached, with f = ${short(design.kappa_inv, 4)}.`;
  }

  say(sentence, bad = false) {
    const status = byId("status");
    if (status.textContent !== sentence) status.textContent = sentence;
    status.classList.toggle("bad", bad);
  }

  showIterate(index) {
    const one = this.search.history[index];
    if (!one) return;
    this.store.hold();
    this.store.change({ problem: { ...this.store.state.problem, manipulator: one.manipulator } });
    this.showReplay(index);
  }

  showReplay(index) {
    const { history: all } = this.search;
    byId("replay").hidden = all.length === 0;
    byId("iterate").max = Math.max(all.length - 1, 0);
    byId("iterate").value = index;
    byId("iterate-of").textContent = `${index} of ${all.length - 1}`;
    drawConvergence(byId("convergence"), all, index);
  }

  searchEnded(found, sentence) {
    byId("stop").disabled = true;
    byId("search").disabled = false;
    if (!found) {
      this.store.release();
      byId("outcome").textContent = sentence;
      return;
    }
    this.found = found;
    this.store.hold();
    this.store.change({ problem: { ...this.store.state.problem, manipulator: found.manipulator } });
    this.store.release();
    this.showReplay(this.search.history.length - 1);
    this.drawNow();
    const { width, height } = this.view;
    const outside = ({ at }) => this.view.toScreen(at).some((value, k) => value < 24 || value > [width - 24, height - 48][k]);
    if (this.handles.some(outside)) this.fit();
    byId("outcome").textContent = found.reaches
      ? `Found: \u03ba\u207b\u00b9 is at least ${short(found.kappa_inv, 5)} along the outline, after ${found.gradient_evaluations} gradients. Save it, and reprise synthesize proves how good it is.`
      : `No design that reaches the region was found; the one shown violates a limit by ${short(found.violation, 3)}. Make the region smaller, or the legs longer.`;
  }

  fit() {
    const { problem, pose } = this.store.state;
    const { workspace, outline } = this.documents;
    const points = [...legsOf(problem.manipulator).map(({ base }) => base), [pose.x, pose.y], ...outline];
    const near = workspace.components.filter(({ boundary }) => {
      const box = boxAbout(boundary);
      const [x, y] = problem.workspace?.centre ?? [pose.x, pose.y];
      return box.left <= x && x <= box.right && box.bottom <= y && y <= box.top;
    });
    for (const { boundary } of near) points.push(...boundary);
    this.view.fit(boxAbout(points));
    this.redraw();
  }

  measure() {
    const { width, height } = byId("stage").getBoundingClientRect();
    this.view.resize(width, height);
    this.map.resize(width, height);
  }

  drawLegend() {
    const context = byId("scale").getContext("2d");
    const image = context.createImageData(128, 1);
    new Uint32Array(image.data.buffer).set(palette.filter((_, k) => k % 2 === 0));
    context.putImageData(image, 0, 0);
  }

  hover([x, y]) {
    if (!this.documents) return;
    byId("pointer").textContent =
      `x ${short(x, 4)}, y ${short(y, 4)}: \u03ba\u207b\u00b9 ${short(this.engine.kappa(x, y, this.shownRange), 4)}`;
  }

  listen() {
    const { store, view } = this;
    listen(byId("scene"), {
      find: (id) => this.handles.find((handle) => handle.id === id),
      store,
      view,
      redraw: () => this.redraw(),
      hover: (at) => this.hover(at),
    });
    byId("preset").addEventListener("change", (event) => this.choose(event.target.value));
    byId("undo").addEventListener("click", () => store.undo());
    byId("redo").addEventListener("click", () => store.redo());
    document.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z") return;
      event.preventDefault();
      if (event.shiftKey) store.redo();
      else store.undo();
    });
    byId("open").addEventListener("click", () => byId("file").click());
    byId("file").addEventListener("change", async ({ target }) => {
      const [file] = target.files;
      target.value = "";
      if (file) this.open(file.name, await file.text());
    });
    byId("save").addEventListener("click", () => this.save());
    byId("link").addEventListener("click", async () => {
      history.replaceState(null, "", `#${await toHash(store.state)}`);
      try {
        await navigator.clipboard.writeText(location.href);
        this.say("The link is in the clipboard; it holds all that is shown.");
      } catch {
        this.say("The address of this page is the link; it holds all that is shown.");
      }
    });
    byId("search").addEventListener("click", () => {
      this.found = null;
      store.hold();
      this.search.start(withOrientations(store.state).problem, byId("formulation").value);
      byId("stop").disabled = false;
      byId("search").disabled = true;
      byId("outcome").textContent = "Searching \u2026";
    });
    byId("stop").addEventListener("click", () => {
      if (this.search.stop()) this.searchEnded(null, "Stopped. The iterate shown is a design like any other.");
    });
    byId("iterate").addEventListener("input", ({ target }) => this.showIterate(Number(target.value)));
    byId("iterate").addEventListener("change", () => store.release());
    byId("closer").addEventListener("click", () => this.zoom(1.25));
    byId("farther").addEventListener("click", () => this.zoom(0.8));
    byId("fit").addEventListener("click", () => this.fit());
    for (const box of document.querySelectorAll("[id^=show-]")) box.addEventListener("change", () => this.redraw());
    window.addEventListener("hashchange", async () => {
      const state = await fromHash(location.hash);
      if (state) this.begin(state);
      else this.say("The address holds no state of this page; what was shown stays.", true);
    });
    new ResizeObserver(() => {
      this.measure();
      if (this.documents) this.drawNow();
    }).observe(byId("stage"));
  }

  zoom(factor) {
    this.view.zoom(factor);
    this.redraw();
  }

  open(name, text) {
    try {
      this.begin(this.stateOf(this.engine.read(name, text), ""));
    } catch (error) {
      this.say(error.message, true);
    }
  }

  /** What is shown, as a problem file. */
  text() {
    return toToml(withOrientations(this.store.state).problem);
  }

  save() {
    const { manipulator } = this.store.state.problem;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([this.text()], { type: "application/toml" }));
    link.download = `${manipulator.name.replace(/[^\w]+/g, "_")}.toml`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
}

const outcomeAtFirst = byId("outcome").textContent;
/** The page, for scripts that drive it. */
globalThis.explorer = new Page();
globalThis.explorer.start().catch((error) => {
  byId("status").textContent = `The page cannot work in this browser: ${error.message}.`;
  byId("status").classList.add("bad");
});
