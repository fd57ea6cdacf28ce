// The prescribed workspace of a problem: choosing one, and dragging its centre, its corners or its size.

/** What may be varied where a file does not say. */
export const freeDesign = (manipulator, reach) =>
  manipulator.design ? { free: ["base", "platform"] } : { free: ["base", "platform"], within: reach };

/** The orientations of a kind of synthesis, as a problem file has them. */
export function orientationsOf(kind, phi, [lower, upper]) {
  if (kind === "SO") return { slices_deg: [phi] };
  return kind === "MO" ? { slices_deg: [lower, (lower + upper) / 2, upper] } : { range_deg: [lower, upper] };
}

/** The kind of synthesis of such a table, with its range. */
export function kindOf(orientations) {
  if (!orientations) return { kind: "SO", range: [-5, 5] };
  if (orientations.range_deg) return { kind: "D", range: orientations.range_deg };
  const slices = orientations.slices_deg;
  if (slices.length === 1) return { kind: "SO", range: [slices[0] - 5, slices[0] + 5] };
  return { kind: "MO", range: [Math.min(...slices), Math.max(...slices)] };
}

/** A shape of one's own about a centre. */
export function ownShape(kind, centre, size) {
  const common = { name: `my ${kind}`, kind };
  if (kind === "rectangle") return { ...common, width: 1.5 * size, height: size, centre };
  if (kind === "circle") return { ...common, radius: size / 2, centre };
  const corner = (degrees) => [
    size * 0.6 * Math.cos((degrees * Math.PI) / 180),
    size * 0.6 * Math.sin((degrees * Math.PI) / 180),
  ];
  return { ...common, vertices: [0, 72, 144, 216, 288].map((turn) => corner(turn + 90)), centre };
}

const radians = (workspace) => ((workspace.rotation_deg ?? 0) * Math.PI) / 180;

/** A point of the shape's own frame in the plane. */
function placed(workspace, [x, y]) {
  const scale = workspace.scale ?? 1;
  const angle = radians(workspace);
  return [
    workspace.centre[0] + scale * (Math.cos(angle) * x - Math.sin(angle) * y),
    workspace.centre[1] + scale * (Math.sin(angle) * x + Math.cos(angle) * y),
  ];
}

/** The other way round. */
function own(workspace, [x, y]) {
  const scale = workspace.scale ?? 1;
  const angle = radians(workspace);
  const [right, up] = [x - workspace.centre[0], y - workspace.centre[1]];
  return [
    (Math.cos(angle) * right + Math.sin(angle) * up) / scale,
    (Math.cos(angle) * up - Math.sin(angle) * right) / scale,
  ];
}

/**
 * Points by which a prescribed workspace is dragged.
 * @param {[number, number][]} outline points of it in the plane
 * @returns {{id: string, label: string, at: number[], moved: (point: number[]) => object}[]} with the workspace that
 *   moving each of them makes
 */
export function grips(workspace, outline) {
  const all = [];
  const add = (id, label, at, moved) => all.push({ id, label, at, moved });
  // The centre itself is where P is at first; the whole is moved by its left end.
  const left = outline.reduce((one, other) => (other[0] < one[0] ? other : one), [Infinity, 0]);
  const middle = [left[0], workspace.centre[1]];
  add("whole", "Prescribed workspace as a whole", middle, ([x, y]) => ({
    ...workspace,
    centre: [workspace.centre[0] + x - middle[0], workspace.centre[1] + y - middle[1]],
  }));
  if (workspace.kind === "rectangle") {
    for (const [k, [right, up]] of [[1, 1], [-1, 1], [-1, -1], [1, -1]].entries()) {
      const at = placed(workspace, [(right * workspace.width) / 2, (up * workspace.height) / 2]);
      add(`corner-${k + 1}`, `Corner ${k + 1} of the rectangle`, at, (point) => {
        const [x, y] = own(workspace, point);
        return { ...workspace, width: Math.max(2 * right * x, 1e-3), height: Math.max(2 * up * y, 1e-3) };
      });
    }
  } else if (workspace.kind === "polygon") {
    workspace.vertices.forEach((vertex, k) => {
      add(`corner-${k + 1}`, `Corner ${k + 1} of the polygon`, placed(workspace, vertex), (point) => ({
        ...workspace,
        vertices: workspace.vertices.map((old, j) => (j === k ? own(workspace, point) : old)),
      }));
    });
  } else if (outline.length > 0) {
    const [start] = outline;
    const distance = ([x, y]) => Math.hypot(x - workspace.centre[0], y - workspace.centre[1]);
    add("size", "Size of the prescribed workspace", start, (point) => ({
      ...workspace,
      scale: Math.max(((workspace.scale ?? 1) * distance(point)) / distance(start), 1e-3),
    }));
  }
  return all;
}
