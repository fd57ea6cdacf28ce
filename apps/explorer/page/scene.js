// What is drawn as SVG: axes, regions, the manipulator and its handles. Elements stay and only their attributes change,
// so that nothing flickers and the focus is not lost.

import { knobOf } from "./handles.js";
import { legsOf, platformJoint } from "./manipulator.js";

const svgNames = "http://www.w3.org/2000/svg";

const pathOf = (points, closed) => {
  const text = points.map(([x, y]) => `${x.toFixed(1)} ${y.toFixed(1)}`).join("L");
  return points.length > 0 ? `M${text}${closed ? "Z" : ""}` : "";
};

/** Numbers for axes: 1, 2 or 5 times a power of ten apart. */
function ticks(from, to, most) {
  const raw = (to - from) / most;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].map((k) => k * power).find((one) => one >= raw);
  const all = [];
  for (let k = Math.ceil(from / step); k * step <= to; ++k) all.push(Number((k * step).toPrecision(12)));
  return all;
}

/** The drawing. */
export class Scene {
  #elements = new Map();
  #used = new Set();

  /** @param {SVGSVGElement} svg */
  constructor(svg) {
    this.svg = svg;
    this.layers = ["axes", "regions", "legs", "handles"].map((name) => {
      const layer = document.createElementNS(svgNames, "g");
      layer.setAttribute("class", name);
      svg.append(layer);
      return layer;
    });
  }

  /** The element of a key, with these attributes; made where it is not there yet. */
  #set(layer, key, tag, attributes) {
    let element = this.#elements.get(key);
    if (!element) {
      element = document.createElementNS(svgNames, tag);
      this.#elements.set(key, element);
      this.layers[layer].append(element);
    }
    this.#used.add(key);
    for (const [name, value] of Object.entries(attributes)) {
      const text = String(value);
      if (name === "text") {
        if (element.textContent !== text) element.textContent = text;
      } else if (element.getAttribute(name) !== text) {
        element.setAttribute(name, text);
      }
    }
    return element;
  }

  #line(layer, key, [x1, y1], [x2, y2], name) {
    const at = { x1: x1.toFixed(1), y1: y1.toFixed(1), x2: x2.toFixed(1), y2: y2.toFixed(1), class: name };
    this.#set(layer, key, "line", at);
  }

  /**
   * Draws a state.
   * @param {object} drawn state, view, handles, paths of components, pose document, outline, singular curves, corners,
   *   and which layers are wanted
   */
  draw({ state, view, handles, shapes, pose, outline, curves, corners, layers, held }) {
    this.#used.clear();
    this.svg.setAttribute("viewBox", `0 0 ${view.width} ${view.height}`);
    this.svg.classList.toggle("bare", !layers.map);
    this.#axes(view);
    shapes.forEach(({ path }, k) => this.#set(1, `region-${k}`, "path", { class: "region", d: path }));
    if (layers.singular) {
      curves.forEach((curve, k) =>
        this.#set(1, `singular-${k}`, "path", { class: "singular", d: pathOf(curve.map((at) => view.toScreen(at)), false) }));
    }
    if (layers.corners) {
      corners.forEach((at, k) => {
        const [cx, cy] = view.toScreen(at);
        this.#set(1, `corner-${k}`, "circle", { class: "corner", cx: cx.toFixed(1), cy: cy.toFixed(1), r: 3.5 });
      });
    }
    if (outline.length > 0) {
      this.#set(1, "prescribed", "path", { class: "prescribed", d: pathOf(outline.map((at) => view.toScreen(at)), true) });
    }
    this.#manipulator(state, view, pose);
    for (const handle of handles) this.#handle(handle, view, held);
    for (const [key, element] of this.#elements) {
      if (this.#used.has(key)) continue;
      element.remove();
      this.#elements.delete(key);
    }
  }

  #axes(view) {
    const { left, right, bottom, top } = view.box;
    for (const x of ticks(left, right, Math.max(2, view.width / 90))) {
      const [at] = view.toScreen([x, 0]);
      this.#line(0, `x ${x}`, [at, view.height - 5], [at, view.height], "axis");
      this.#set(0, `x text ${x}`, "text", { class: "tick", x: at.toFixed(1), y: view.height - 8, "text-anchor": "middle", text: x });
    }
    for (const y of ticks(bottom, top, Math.max(2, view.height / 70))) {
      const [, at] = view.toScreen([0, y]);
      this.#line(0, `y ${y}`, [0, at], [5, at], "axis");
      this.#set(0, `y text ${y}`, "text", { class: "tick", x: 8, y: (at + 4).toFixed(1), text: y });
    }
  }

  #manipulator(state, view, pose) {
    const legs = legsOf(state.problem.manipulator);
    const joints = legs.map((leg) => view.toScreen(platformJoint(leg, state.pose)));
    const point = view.toScreen([state.pose.x, state.pose.y]);
    legs.forEach((leg, k) => {
      const base = view.toScreen(leg.base);
      const joint = joints[k];
      const bad = pose.limits.some(({ limit, holds }) => !holds && limit.startsWith(`leg ${k + 1},`)) ? " bad" : "";
      // The cylinder is as long as the shortest leg.
      const length = Math.hypot(joint[0] - base[0], joint[1] - base[1]) || 1;
      const share = Math.min(1, (leg.length[0] * view.scale * 0.8) / length);
      const end = [base[0] + share * (joint[0] - base[0]), base[1] + share * (joint[1] - base[1])];
      this.#line(2, `leg line ${k}`, base, joint, "leg-line");
      this.#line(2, `leg rod ${k}`, base, end, `leg-rod${bad}`);
      this.#line(2, `leg core ${k}`, base, joint, `leg-core${bad}`);
      const [x, y] = base;
      this.#set(2, `ground ${k}`, "path", {
        class: "ground",
        d: `M${x.toFixed(1)} ${y.toFixed(1)}l-11 19h22zm-15 19h30m-26 0l-5 6m13-6l-5 6m13-6l-5 6m13-6l-5 6`,
      });
    });
    const about = [...joints, point];
    const [middleX, middleY] = [0, 1].map((k) => about.reduce((sum, at) => sum + at[k], 0) / about.length);
    const angle = ([x, y]) => Math.atan2(y - middleY, x - middleX);
    const corners = about.length > 2 ? [...about].sort((one, other) => angle(one) - angle(other)) : about;
    this.#set(2, "platform", "path", { class: "platform", d: pathOf(corners, true) });
    this.#line(2, "turner", point, view.toScreen(knobOf(state.pose, view)), "turner");
  }

  #handle({ id, kind, label, at, value }, view, held) {
    const [x, y] = view.toScreen(at);
    const group = this.#set(3, `handle ${id}`, "g", {
      class: `handle ${kind}${held === id ? " held" : ""}`,
      "data-handle": id,
      tabindex: 0,
      role: "button",
      "aria-label": `${label}, ${value}; arrow keys move it`,
      transform: `translate(${x.toFixed(2)} ${y.toFixed(2)})`,
    });
    if (group.childElementCount === 0) {
      const size = { point: 8, knob: 6, target: 6, joint: 7 }[kind];
      for (const [name, r] of [["hit", 17], ["mark", size]]) {
        const circle = document.createElementNS(svgNames, "circle");
        circle.setAttribute("class", name);
        circle.setAttribute("r", r);
        group.append(circle);
      }
      const short = { point: "P" }[kind] ?? (id.startsWith("base") ? id.slice(5) : "");
      if (short) {
        const text = document.createElementNS(svgNames, "text");
        text.setAttribute("class", "label");
        text.setAttribute("x", kind === "point" ? 10 : -4);
        text.setAttribute("y", kind === "point" ? -9 : 40);
        text.textContent = short;
        group.append(text);
      }
    }
  }
}
