// Regions of a workspace document as paths on the screen. SVG and canvas draw circular arcs, so the exact region is drawn
// exactly.

const number = (value) => value.toFixed(2);

/** One arc or segment, drawn on from its start. */
function edgePath(edge, view) {
  const [x, y] = view.toScreen(edge.to);
  if (!edge.radius) return `L${number(x)} ${number(y)}`;
  const radius = edge.radius * view.scale;
  const arc = (large, [right, down]) =>
    `A${number(radius)} ${number(radius)} 0 ${large} ${edge.sweep_deg > 0 ? 0 : 1} ${number(right)} ${number(down)}`;
  if (Math.abs(edge.sweep_deg) < 359) return arc(Math.abs(edge.sweep_deg) > 180 ? 1 : 0, [x, y]);
  const opposite = [2 * edge.centre[0] - edge.from[0], 2 * edge.centre[1] - edge.from[1]];
  return arc(0, view.toScreen(opposite)) + arc(0, [x, y]);
}

/** The path of a component of a workspace document, with its holes. */
export function componentPath(component, view) {
  let path = "";
  let last = null;
  for (const edge of component.edges) {
    if (last === null || edge.from[0] !== last[0] || edge.from[1] !== last[1]) {
      const [x, y] = view.toScreen(edge.from);
      path += `${path ? "Z" : ""}M${number(x)} ${number(y)}`;
    }
    path += edgePath(edge, view);
    last = edge.to;
  }
  return path ? `${path}Z` : "";
}
