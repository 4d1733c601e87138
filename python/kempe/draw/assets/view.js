// Which part of the plane a canvas shows: the only place where metres become pixels.

const MARGIN = 56;
/** Room at the lower edge for scales, px. */
const FOOT = 26;

/** The larger side of what a motion covers, m. */
export function extent([x0, y0, x1, y1]) {
  return Math.max(x1 - x0, y1 - y0) || 1;
}

/** The part of the plane that is seen: px = middle + scale (x - cx), upside down for y. */
export class View {
  constructor(bounds) {
    this.bounds = bounds;
    this.width = 1;
    this.height = 1;
    this.fit();
  }

  /** Show all of the motion. */
  fit() {
    const [x0, y0, x1, y1] = this.bounds;
    this.center = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.scale = this.fitted();
    this.moved = false;
  }

  /** Scale at which all of the motion just fits, px/m. */
  fitted() {
    const [x0, y0, x1, y1] = this.bounds;
    const margin = Math.min(MARGIN, 0.15 * Math.min(this.width, this.height));
    const wide = x1 > x0 ? (this.width - 2 * margin) / (x1 - x0) : Infinity;
    const high = y1 > y0 ? (this.height - FOOT - 2 * margin) / (y1 - y0) : Infinity;
    const scale = Math.min(wide, high);
    return Number.isFinite(scale) && scale > 0 ? scale : 100;
  }

  /** The canvas has another size, in CSS pixels. */
  resize(width, height) {
    const before = this.fitted();
    this.width = width;
    this.height = height;
    if (this.moved) this.scale *= this.fitted() / before;
    else this.fit();
  }

  /** Where the middle of the motion is when all of it is shown, px. */
  middle() {
    return [this.width / 2, (this.height - FOOT) / 2];
  }

  toScreen([x, y]) {
    const [[mx, my], { scale, center }] = [this.middle(), this];
    return [mx + scale * (x - center[0]), my - scale * (y - center[1])];
  }

  toPlane([px, py]) {
    const [[mx, my], { scale, center }] = [this.middle(), this];
    return [center[0] + (px - mx) / scale, center[1] - (py - my) / scale];
  }

  /** Zoom so that the point under `at` (px) stays where it is. */
  zoom(factor, at = this.middle()) {
    const fitted = this.fitted();
    const before = this.toPlane(at);
    this.scale = Math.min(1e4 * fitted, Math.max(0.02 * fitted, this.scale * factor));
    const after = this.toPlane(at);
    this.center = [this.center[0] + before[0] - after[0], this.center[1] + before[1] - after[1]];
    this.moved = true;
  }

  /** Move the drawing by so many pixels. */
  pan(dx, dy) {
    this.center = [this.center[0] - dx / this.scale, this.center[1] + dy / this.scale];
    this.moved = true;
  }

  /** The same as a matrix for paths in metres. */
  matrix() {
    const [e, f] = this.toScreen([0, 0]);
    return new DOMMatrix([this.scale, 0, 0, -this.scale, e, f]);
  }
}
