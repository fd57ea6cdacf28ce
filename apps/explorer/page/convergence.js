// The convergence of a search, as in Figures 5.9, 5.14 and 5.17: kappa^-1 of the iterates, and how far they violate limits.

const svgNames = "http://www.w3.org/2000/svg";
const [width, height] = [370, 130];
const margin = { left: 34, right: 8, top: 8, bottom: 20 };

function element(tag, attributes, text = "") {
  const made = document.createElementNS(svgNames, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.textContent = text;
  return made;
}

/**
 * Draws the iterates.
 * @param {SVGSVGElement} svg
 * @param {{kappa_inv: number, violation: number}[]} history
 * @param {number} shown which of them is marked
 */
export function drawConvergence(svg, history, shown) {
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  const count = Math.max(history.length - 1, 1);
  const across = (k) => margin.left + (k / count) * (width - margin.left - margin.right);
  const up = (value) => height - margin.bottom - value * (height - margin.top - margin.bottom);
  const worst = Math.max(...history.map(({ violation }) => violation), 1e-12);
  const line = (values) => values.map((value, k) => `${k ? "L" : "M"}${across(k).toFixed(1)} ${up(value).toFixed(1)}`).join("");
  const parts = [];
  for (const value of [0, 0.5, 1]) {
    parts.push(element("line", { class: "axis", x1: margin.left, x2: width - margin.right, y1: up(value), y2: up(value) }));
    parts.push(element("text", { class: "tick", x: 4, y: up(value) + 4 }, value));
  }
  if (history.length > 0) {
    parts.push(element("path", { class: "curve violation", d: line(history.map(({ violation }) => violation / worst)) }));
    parts.push(element("path", { class: "curve", d: line(history.map(({ kappa_inv: value }) => value)) }));
    parts.push(element("line", { class: "cursor", x1: across(shown), x2: across(shown), y1: margin.top, y2: height - margin.bottom }));
    parts.push(element("text", { class: "tick", x: margin.left, y: height - 5 },
      `\u03ba\u207b\u00b9 (line) and violation / ${worst.toPrecision(2)} (dashed); ${history.length - 1} iterates`));
  }
  svg.replaceChildren(...parts);
  svg.setAttribute("aria-label", history.length > 0
    ? `Convergence: the least inverse condition number goes from ${history[0].kappa_inv.toPrecision(4)} to ${history.at(-1).kappa_inv.toPrecision(4)} in ${history.length - 1} iterates`
    : "Convergence of the search; there was none yet");
}
