// Which part of the plane is seen: from lengths to pixels and back.

/** A box about points, or null without any. */
export function boxAbout(points) {
  if (points.length === 0) return null;
  const xs = points.map(([x]) => x);
  const ys = points.map(([, y]) => y);
  return { left: Math.min(...xs), right: Math.max(...xs), bottom: Math.min(...ys), top: Math.max(...ys) };
}

/** The part of the plane that is seen. */
export class View {
  width = 1;
  height = 1;
  centre = [0, 0];
  /** Pixels to a length. */
  scale = 100;

  resize(width, height) {
    this.width = width;
    this.height = height;
  }

  /** Shows a box with a margin. */
  fit({ left, right, bottom, top }) {
    this.centre = [(left + right) / 2, (bottom + top) / 2];
    const margin = Math.min(56, this.width / 8);
    this.scale = Math.min((this.width - 2 * margin) / (right - left || 1), (this.height - 2 * margin) / (top - bottom || 1));
  }

  /** Enlarges about a point of the screen. */
  zoom(factor, at = [this.width / 2, this.height / 2]) {
    const [x, y] = this.toPlane(at);
    this.scale *= factor;
    const [nowX, nowY] = this.toPlane(at);
    this.centre = [this.centre[0] + x - nowX, this.centre[1] + y - nowY];
  }

  pan(right, down) {
    this.centre = [this.centre[0] - right / this.scale, this.centre[1] + down / this.scale];
  }

  toScreen([x, y]) {
    return [
      this.width / 2 + (x - this.centre[0]) * this.scale,
      this.height / 2 - (y - this.centre[1]) * this.scale,
    ];
  }

  toPlane([right, down]) {
    return [
      this.centre[0] + (right - this.width / 2) / this.scale,
      this.centre[1] - (down - this.height / 2) / this.scale,
    ];
  }

  /** The part that is seen. */
  get box() {
    const [left, top] = this.toPlane([0, 0]);
    const [right, bottom] = this.toPlane([this.width, this.height]);
    return { left, right, bottom, top };
  }
}
