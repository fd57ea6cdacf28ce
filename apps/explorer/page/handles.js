// Everything that is dragged: by the mouse, by a finger, or by the arrow keys.

import { legsOf, platformJoint, withBase, withPlatform } from "./manipulator.js";
import { grips } from "./prescribed.js";

/** How far the knob that turns the platform is from P, pixels. */
export const knobDistance = 74;

/** The angle between -180 and 180 degrees, to a tenth. */
export const tidyAngle = (degrees) => Math.round((degrees - 360 * Math.round(degrees / 360)) * 10) / 10;

const rounded = (value, scale) => {
  const digits = Math.max(0, Math.ceil(Math.log10(scale)) + 1);
  return Number(value.toFixed(Math.min(digits, 12)));
};

/** Where the knob is. */
export function knobOf(pose, view) {
  const angle = (pose.phi * Math.PI) / 180;
  const distance = knobDistance / view.scale;
  return [pose.x - distance * Math.sin(angle), pose.y + distance * Math.cos(angle)];
}

/**
 * The handles of a state, those drawn last on top.
 * @returns {{id: string, kind: string, label: string, at: number[], moved: (point: number[]) => object}[]} with the part
 *   of the state that moving each of them changes
 */
export function handlesOf(state, view, outline) {
  const { problem, pose } = state;
  const tidy = ([x, y]) => [rounded(x, view.scale), rounded(y, view.scale)];
  const withManipulator = (manipulator) => ({ problem: { ...problem, manipulator } });
  const all = [];
  if (problem.workspace) {
    for (const grip of grips(problem.workspace, outline)) {
      all.push({
        ...grip,
        kind: "target",
        moved: (point) => ({ problem: { ...problem, workspace: grip.moved(tidy(point)) } }),
      });
    }
  }
  legsOf(problem.manipulator).forEach((leg, k) => {
    all.push({
      id: `base-${k + 1}`,
      kind: "joint",
      label: `Base joint ${k + 1}`,
      at: leg.base,
      moved: (point) => withManipulator(withBase(problem.manipulator, k, tidy(point))),
    });
  });
  const seen = new Set();
  legsOf(problem.manipulator).forEach((leg, k) => {
    const at = platformJoint(leg, pose);
    if (seen.has(String(at))) return;
    seen.add(String(at));
    all.push({
      id: `platform-${k + 1}`,
      kind: "joint",
      label: `Platform joint ${k + 1}`,
      at,
      moved: (point) => withManipulator(withPlatform(problem.manipulator, k, tidy(point), pose)),
    });
  });
  all.push({
    id: "knob",
    kind: "knob",
    label: "Orientation of the platform",
    at: knobOf(pose, view),
    moved: ([x, y]) => {
      const phi = tidyAngle((Math.atan2(pose.x - x, y - pose.y) * 180) / Math.PI);
      return { pose: { ...pose, phi } };
    },
  });
  all.push({
    id: "point",
    kind: "point",
    label: "Working point P",
    at: [pose.x, pose.y],
    moved: (point) => {
      const [x, y] = tidy(point);
      return { pose: { ...pose, x, y } };
    },
  });
  return all;
}

/** Pixels that an arrow key moves a handle by. */
const keySteps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/**
 * Lets handles be dragged, and the plane be moved and enlarged.
 * @param {SVGSVGElement} svg in which handles are elements with data-handle
 * @param {{find: (id: string) => object, store: object, view: object, redraw: () => void, hover: (point: number[]) => void}} page
 */
export function listen(svg, { find, store, view, redraw, hover }) {
  const held = new Map();
  let spread = 0;
  const pointOf = (event) => {
    const box = svg.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  svg.addEventListener("pointerdown", (event) => {
    const element = event.target.closest("[data-handle]");
    const at = pointOf(event);
    svg.setPointerCapture(event.pointerId);
    if (element) {
      const handle = find(element.dataset.handle);
      const [x, y] = view.toScreen(handle.at);
      held.set(event.pointerId, { id: handle.id, from: at, offset: [x - at[0], y - at[1]] });
      svg.querySelector(`[data-handle="${handle.id}"]`)?.focus({ preventScroll: true });
      store.hold();
    } else {
      held.set(event.pointerId, { id: null, from: at });
    }
    event.preventDefault();
  });
  svg.addEventListener("pointermove", (event) => {
    const at = pointOf(event);
    const grip = held.get(event.pointerId);
    if (!grip) {
      hover(view.toPlane(at));
      return;
    }
    const fingers = [...held.values()].filter(({ id }) => id === null);
    if (grip.id !== null) {
      const target = [at[0] + grip.offset[0], at[1] + grip.offset[1]];
      const [x, y] = grip.offset;
      // The knob turns with the hand from where it was touched.
      store.change(find(grip.id).moved(view.toPlane(grip.id === "knob" ? [target[0] - x, target[1] - y] : target)));
    } else if (fingers.length === 2) {
      grip.from = at;
      const [one, other] = fingers;
      const now = Math.hypot(one.from[0] - other.from[0], one.from[1] - other.from[1]);
      if (spread > 0 && now > 0) view.zoom(now / spread, [(one.from[0] + other.from[0]) / 2, (one.from[1] + other.from[1]) / 2]);
      spread = now;
      redraw();
    } else {
      view.pan(at[0] - grip.from[0], at[1] - grip.from[1]);
      grip.from = at;
      redraw();
    }
  });
  const end = (event) => {
    const grip = held.get(event.pointerId);
    held.delete(event.pointerId);
    spread = 0;
    if (grip?.id) store.release();
  };
  svg.addEventListener("pointerup", end);
  svg.addEventListener("pointercancel", end);
  svg.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom(Math.exp(-event.deltaY / 400), pointOf(event));
    redraw();
  }, { passive: false });
  svg.addEventListener("keydown", (event) => {
    const step = keySteps[event.key];
    const id = event.target.closest?.("[data-handle]")?.dataset.handle;
    if (!step || !id) return;
    event.preventDefault();
    store.hold();
    const handle = find(id);
    const pixels = event.shiftKey ? 10 : 2;
    const [x, y] = view.toScreen(handle.at);
    store.change(handle.moved(view.toPlane([x + pixels * step[0], y + pixels * step[1]])));
  });
  svg.addEventListener("keyup", (event) => {
    if (keySteps[event.key]) store.release();
  });
}
