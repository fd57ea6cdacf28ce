// kappa^-1 over the workspace, as colours with contours, on a canvas.

import { contours } from "d3-contour";

import { palette } from "./colours.js";
import { boxAbout } from "./view.js";

/** Positions of all components together at which kappa^-1 is computed. */
const positions = 150 * 150;
/** Contours take every so many of them. */
const coarser = 2;
const levels = Array.from({ length: 19 }, (_, k) => (k + 1) / 20);

/** A grid over the part of a component that is seen, and a little more; null where none of it is. */
function gridOver(component, view, share) {
  const about = boxAbout(component.boundary);
  const seen = view.box;
  const box = {
    left: Math.max(about.left, seen.left),
    right: Math.min(about.right, seen.right),
    bottom: Math.max(about.bottom, seen.bottom),
    top: Math.min(about.top, seen.top),
  };
  const width = box.right - box.left;
  const height = box.top - box.bottom;
  if (!(width > 0 && height > 0)) return null;
  const columns = Math.max(8, Math.min(300, Math.round(Math.sqrt((positions * share * width) / height))));
  const rows = Math.max(8, Math.min(300, Math.round((positions * share) / columns)));
  const border = { x: (2 * width) / columns, y: (2 * height) / rows };
  return {
    box: { left: box.left - border.x, right: box.right + border.x, bottom: box.bottom - border.y, top: box.top + border.y },
    columns,
    rows,
  };
}

/** Draws maps on a canvas. */
export class KappaMap {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.tile = document.createElement("canvas");
    this.tileContext = this.tile.getContext("2d");
  }

  resize(width, height) {
    const density = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * density);
    this.canvas.height = Math.round(height * density);
    this.density = density;
  }

  clear() {
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
  }

  /**
   * Draws kappa^-1 over all components.
   * @param {{component: object, path: string}[]} shapes components of a workspace document with their paths
   * @param {{map: boolean, contours: boolean}} layers
   * @returns {[number, number] | null} the least and greatest value that have a colour
   */
  draw(engine, view, shapes, range, layers) {
    this.clear();
    if (!layers.map && !layers.contours) return null;
    const sizes = shapes.map(({ component }) => gridOver(component, view, 1));
    const seen = sizes.filter((grid) => grid).length;
    const grids = shapes
      .map((shape) => ({ ...shape, grid: gridOver(shape.component, view, 1 / Math.max(seen, 1)) }))
      .filter(({ grid }) => grid);
    for (const one of grids) one.values = Float32Array.from(engine.map(one.grid.box, one.grid.columns, one.grid.rows, range));
    let lowest = Infinity;
    let highest = -Infinity;
    for (const { values } of grids) {
      for (const value of values) {
        if (value < lowest) lowest = value;
        if (value > highest) highest = value;
      }
    }
    // Where all poses are as good as singular, the rest is rounding.
    highest = Math.max(highest, lowest + 1e-6);
    for (const { grid, values, path } of grids) {
      this.context.setTransform(this.density, 0, 0, this.density, 0, 0);
      this.context.save();
      this.context.clip(new Path2D(path), "evenodd");
      if (layers.map) this.#colour(view, grid, values, lowest, highest);
      const labels = layers.contours ? this.#contours(view, grid, values, path, lowest, highest, layers.map) : [];
      this.context.restore();
      this.#label(labels);
    }
    return grids.length > 0 ? [lowest, highest] : null;
  }

  #colour(view, { box, columns, rows }, values, lowest, highest) {
    this.tile.width = columns;
    this.tile.height = rows;
    const image = this.tileContext.createImageData(columns, rows);
    const pixels = new Uint32Array(image.data.buffer);
    const factor = 255.999 / (highest - lowest);
    for (let row = 0; row < rows; ++row) {
      const above = (rows - 1 - row) * columns;
      for (let column = 0; column < columns; ++column) {
        pixels[above + column] = palette[((values[row * columns + column] - lowest) * factor) | 0];
      }
    }
    this.tileContext.putImageData(image, 0, 0);
    // Values are those of the middles of the pixels.
    const [left, top] = view.toScreen([box.left, box.top]);
    const width = ((box.right - box.left) * view.scale) / (columns - 1);
    const height = ((box.top - box.bottom) * view.scale) / (rows - 1);
    this.context.drawImage(this.tile, left - width / 2, top - height / 2, width * columns, height * rows);
  }

  #contours(view, { box, columns, rows }, values, path, lowest, highest, onColours) {
    const across = Math.floor((columns - 1) / coarser) + 1;
    const up = Math.floor((rows - 1) / coarser) + 1;
    const fewer = new Float32Array(across * up);
    for (let row = 0; row < up; ++row) {
      for (let column = 0; column < across; ++column) {
        fewer[row * across + column] = values[row * coarser * columns + column * coarser];
      }
    }
    const stepX = (coarser * (box.right - box.left)) / (columns - 1);
    const stepY = (coarser * (box.top - box.bottom)) / (rows - 1);
    const place = ([column, row]) => view.toScreen([box.left + (column - 0.5) * stepX, box.bottom + (row - 0.5) * stepY]);
    const shown = levels.filter((level) => level > lowest && level < highest);
    const every = shown.length > 9 ? 2 : 1;
    const { context } = this;
    const ink = getComputedStyle(this.canvas).getPropertyValue(onColours ? "--joint" : "--faint") || "#888";
    const labels = [];
    context.lineWidth = 1;
    const outline = new Path2D(path);
    const draw = contours().size([across, up]).smooth(true);
    for (const level of shown) {
      if (every === 2 && Math.round(level * 20) % 2) continue;
      context.strokeStyle = onColours ? "rgb(255 255 255 / 75%)" : ink;
      context.beginPath();
      const inside = [];
      for (const polygon of draw.contour(fewer, level).coordinates) {
        for (const ring of polygon) {
          ring.forEach((point, k) => {
            const [x, y] = place(point);
            if (k === 0) context.moveTo(x, y);
            else context.lineTo(x, y);
            const onBorder = point[0] < 1 || point[1] < 1 || point[0] > across - 1 || point[1] > up - 1;
            if (k % 4 === 0 && !onBorder && context.isPointInPath(outline, x * this.density, y * this.density, "evenodd")) {
              inside.push([x, y]);
            }
          });
        }
      }
      context.stroke();
      if (inside.length < 3) continue;
      labels.push({ text: String(level), at: inside[Math.floor(inside.length / 3)] });
    }
    return labels;
  }

  #label(labels) {
    const { context } = this;
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "center";
    context.lineWidth = 3;
    context.strokeStyle = "rgb(0 0 0 / 55%)";
    context.fillStyle = "#fff";
    for (const { text, at: [x, y] } of labels) {
      context.strokeText(text, x, y + 4);
      context.fillText(text, x, y + 4);
    }
  }
}
