// The controls beside the picture: what they show, and what they change.

import { legsOf, withFreeJoints, withLength } from "./manipulator.js";
import { freeDesign, orientationsOf, ownShape } from "./prescribed.js";

const byId = (id) => document.getElementById(id);

/** A number for people. */
export const short = (value, digits = 5) =>
  value === null || value === undefined || !Number.isFinite(value) ? "none" : String(Number(value.toPrecision(digits)));

/** Sets what a control shows, unless the user is typing there. */
function put(input, value) {
  if (document.activeElement !== input || input.type === "range") input.value = value;
}

/** The problem with a table of orientations that says what the page shows. */
export function withOrientations(state) {
  const { problem, kind, pose, range } = state;
  if (!problem.workspace) return state;
  return { ...state, problem: { ...problem, orientations: orientationsOf(kind, pose.phi, range) } };
}

/** The controls. */
export class Panel {
  /** @param {{store: object, presets: object, toPose: (pose: object) => void}} page */
  constructor({ store, presets, own }) {
    this.store = store;
    this.presets = presets;
    this.own = own;
    this.sliders = 2;
    this.#fillRegions();
    this.#listen();
  }

  #fillRegions() {
    const region = byId("region");
    const add = (value, text) => region.append(new Option(text, value));
    add("none", "none");
    for (const name of ["P1", "P2", "P3"]) add(name, name);
    add("rectangle", "my rectangle");
    add("circle", "my circle");
    add("polygon", "my polygon");
    add("file", "as in the file");
  }

  #listen() {
    const { store } = this;
    const change = (part) => store.change(part);
    const whileHeld = (input, act) => {
      input.addEventListener("input", () => {
        store.hold();
        act(Number(input.value));
      });
      input.addEventListener("change", () => store.release());
    };
    byId("region").addEventListener("change", (event) => this.#chooseRegion(event.target.value));
    whileHeld(byId("size"), (value) => {
      const { problem, base } = store.state;
      if (problem.workspace) change({ problem: { ...problem, workspace: { ...problem.workspace, scale: base * value } } });
    });
    for (const radio of document.querySelectorAll("input[name=kind]")) {
      radio.addEventListener("change", () => change({ kind: radio.value }));
    }
    for (const [k, id] of ["lower", "upper"].entries()) {
      byId(id).addEventListener("change", (event) => {
        const range = [...store.state.range];
        range[k] = Number(event.target.value);
        change({ range });
      });
    }
    for (const id of ["x", "y", "phi"]) {
      byId(id).addEventListener("change", (event) => {
        if (event.target.value !== "") change({ pose: { ...store.state.pose, [id]: Number(event.target.value) } });
      });
    }
    whileHeld(byId("turn"), (phi) => change({ pose: { ...store.state.pose, phi } }));
    byId("free").addEventListener("click", () => {
      const { problem } = store.state;
      const manipulator = withFreeJoints(problem.manipulator, this.characteristicLength);
      const design = freeDesign(manipulator, this.reach);
      change({ problem: problem.workspace ? { ...problem, manipulator, design } : { manipulator } });
    });
  }

  #chooseRegion(value) {
    const { problem, pose, kind, range } = this.store.state;
    const { manipulator } = problem;
    if (value === "none") {
      this.store.change({ problem: { manipulator } });
      return;
    }
    const shape = ["rectangle", "circle", "polygon"].includes(value)
      ? ownShape(value, this.own().centre, this.own().size)
      : this.presets.shape(value);
    if (!shape) return;
    this.store.change({
      problem: {
        manipulator,
        workspace: shape,
        orientations: orientationsOf(kind, pose.phi, range),
        design: problem.design ?? freeDesign(manipulator, this.reach),
      },
      base: shape.scale ?? 1,
    });
  }

  /** Half of the longest leg: how far joints may go from where they are. */
  get reach() {
    return Math.max(...legsOf(this.store.state.problem.manipulator).map(({ length }) => length[1])) / 2;
  }

  /** Fits the sliders of the legs to a manipulator; to be called where another one is shown. */
  fitSliders() {
    const longest = Math.max(...legsOf(this.store.state.problem.manipulator).map(({ length }) => length[1]));
    this.sliders = Number((1.6 * longest).toPrecision(2));
    byId("legs").replaceChildren();
  }

  #legs(legs) {
    const list = byId("legs");
    if (list.childElementCount !== legs.length) {
      list.replaceChildren(...legs.map((_, index) => this.#legRow(index)));
    }
    legs.forEach(({ length }, index) => {
      const row = list.children[index];
      for (const end of [0, 1]) {
        row.querySelectorAll("input")[end].value = length[end];
        row.querySelectorAll("output")[end].textContent = short(length[end], 4);
      }
    });
  }

  #legRow(index) {
    const row = document.createElement("div");
    row.className = "leg";
    row.append(`leg ${index + 1}`);
    for (const end of [0, 1]) {
      const input = document.createElement("input");
      Object.assign(input, { type: "range", min: 0, max: this.sliders, step: this.sliders / 400, id: `leg-${index + 1}-${end ? "max" : "min"}` });
      input.setAttribute("aria-label", `${end ? "Greatest" : "Least"} length of leg ${index + 1}`);
      input.addEventListener("input", () => {
        const { problem } = this.store.state;
        const [least, greatest] = legsOf(problem.manipulator)[index].length;
        const value = end ? Math.max(Number(input.value), least, this.sliders / 400) : Math.min(Number(input.value), greatest);
        this.store.hold();
        this.store.change({ problem: { ...problem, manipulator: withLength(problem.manipulator, index, end, value) } });
      });
      input.addEventListener("change", () => this.store.release());
      row.append(input, document.createElement("output"));
    }
    return row;
  }

  /** Shows a state and the documents about it. */
  show(state, { pose, workspace, design, modes, orientation }) {
    const { problem } = state;
    this.characteristicLength = pose.characteristic_length;
    byId("undo").disabled = !this.store.canUndo;
    byId("redo").disabled = !this.store.canRedo;
    for (const radio of document.querySelectorAll("input[name=kind]")) radio.checked = radio.value === state.kind;
    byId("range").hidden = state.kind === "SO";
    put(byId("lower"), state.range[0]);
    put(byId("upper"), state.range[1]);
    put(byId("x"), state.pose.x);
    put(byId("y"), state.pose.y);
    put(byId("phi"), state.pose.phi);
    put(byId("turn"), state.pose.phi);
    byId("free").hidden = !problem.manipulator.design;
    byId("region").value = this.#regionName(problem.workspace);
    byId("size").disabled = !problem.workspace;
    put(byId("size"), problem.workspace ? (problem.workspace.scale ?? 1) / state.base : 1);
    byId("search").disabled = !problem.workspace;
    this.#legs(legsOf(problem.manipulator));
    this.#values(state, { pose, workspace, design, orientation });
    this.#modes(modes, state.pose);
  }

  #regionName(workspace) {
    if (!workspace) return "none";
    if (["P1", "P2", "P3"].includes(workspace.name)) return workspace.name;
    return workspace.name === `my ${workspace.kind}` ? workspace.kind : "file";
  }

  #values(state, { pose, workspace, design, orientation }) {
    const unit = state.problem.manipulator.unit;
    const holes = workspace.components.reduce((sum, { holes: all }) => sum + all.length, 0);
    const corners = workspace.components.reduce((sum, one) => sum + one.bifurcation_points.length, 0);
    const parts = workspace.components.length;
    const turns = orientation.intervals_deg.map(([from, to]) => `${short(from, 3)}\u00b0 to ${short(to, 3)}\u00b0`).join(", ");
    const entries = [
      ["area", "area", workspace.area, `${short(workspace.area)}${unit ? ` ${unit}\u00b2` : ""}`],
      ["parts", "parts, holes, corners", parts, `${parts}, ${holes}, ${corners}`],
      ["kappa", "\u03ba\u207b\u00b9 at P", pose.kappa_inv, short(pose.kappa_inv)],
      ["f", "f: least \u03ba\u207b\u00b9 of the region", design.kappa_inv, short(design.kappa_inv)],
      ["g", "g: out of reach", design.constraint, short(design.constraint, 3), design.constraint > 1e-5],
      ["turns", "P can turn", orientation.intervals_deg.length, turns || "not at all", !turns],
    ];
    const list = byId("values");
    if (list.childElementCount === 0) {
      for (const [id, title] of entries) {
        const group = document.createElement("div");
        const term = document.createElement("dt");
        const value = document.createElement("dd");
        term.textContent = title;
        value.id = `value-${id}`;
        group.append(term, value);
        list.append(group);
      }
    }
    for (const [id, , value, text, bad] of entries) {
      const element = byId(`value-${id}`);
      element.textContent = text;
      element.dataset.value = value ?? "";
      element.classList.toggle("bad", Boolean(bad));
    }
  }

  #modes({ modes, infinitely_many: many }, pose) {
    const list = byId("modes");
    const text = many ? "The leg lengths leave a motion free." : "assembly modes:";
    if (list.childElementCount !== modes.length || list.firstChild?.textContent !== text) {
      list.replaceChildren(text, ...modes.map((_, k) => {
        const button = document.createElement("button");
        button.textContent = k + 1;
        button.dataset.mode = k;
        button.addEventListener("click", () => {
          const { x, y, orientation_deg: phi } = this.shownModes[k];
          this.store.change({ pose: { x, y, phi } });
        });
        return button;
      }));
    }
    this.shownModes = modes;
    for (const button of list.querySelectorAll("button")) {
      const mode = modes[Number(button.dataset.mode)];
      const size = Math.max(...legsOf(this.store.state.problem.manipulator).map(({ length }) => length[1]));
      const here = Math.hypot(mode.x - pose.x, mode.y - pose.y) < 1e-6 * size;
      button.setAttribute("aria-pressed", here);
      button.title = `x ${short(mode.x)}, y ${short(mode.y)}, ${short(mode.orientation_deg, 4)}\u00b0, \u03ba\u207b\u00b9 ${short(mode.kappa_inv, 4)}${mode.within_limits ? "" : ", beyond a limit"}`;
    }
  }
}
