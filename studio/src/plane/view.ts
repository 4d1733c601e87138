// The part of the plane that a canvas shows. Only this module converts metres to pixels.
import type { Spread } from "./gestures";
import type { Point } from "./points";

export type Bounds = readonly [number, number, number, number];

const MARGIN = 56;
/** Room at the lower edge for scales, px. */
const FOOT = 26;

/** The larger side of a rectangle, m. */
export function extent([x0, y0, x1, y1]: Bounds): number {
  return Math.max(x1 - x0, y1 - y0) || 1;
}

/** The visible part of the plane: px = middle + scale (x - cx), and the same with the opposite sign for y. */
export class View {
  bounds: Bounds;
  width = 1;
  height = 1;
  center: Point = [0, 0];
  scale = 100;
  moved = false;

  constructor(bounds: Bounds) {
    this.bounds = bounds;
    this.fit();
  }

  /** Show all of the motion. */
  fit(): void {
    const [x0, y0, x1, y1] = this.bounds;
    this.center = [(x0 + x1) / 2, (y0 + y1) / 2];
    this.scale = this.fitted();
    this.moved = false;
  }

  /** Scale at which all of the motion just fits, px/m. */
  fitted(): number {
    const [x0, y0, x1, y1] = this.bounds;
    const margin = Math.min(MARGIN, 0.15 * Math.min(this.width, this.height));
    const wide = x1 > x0 ? (this.width - 2 * margin) / (x1 - x0) : Number.POSITIVE_INFINITY;
    const high = y1 > y0 ? (this.height - FOOT - 2 * margin) / (y1 - y0) : Number.POSITIVE_INFINITY;
    const scale = Math.min(wide, high);
    return Number.isFinite(scale) && scale > 0 ? scale : 100;
  }

  /** Set the size of the canvas, in CSS pixels. */
  resize(width: number, height: number): void {
    const before = this.fitted();
    this.width = width;
    this.height = height;
    if (this.moved) this.scale *= this.fitted() / before;
    else this.fit();
  }

  /** The middle of the canvas without the room at the lower edge, px. */
  middle(): Point {
    return [this.width / 2, (this.height - FOOT) / 2];
  }

  toScreen([x, y]: Point): Point {
    const [mx, my] = this.middle();
    return [mx + this.scale * (x - this.center[0]), my - this.scale * (y - this.center[1])];
  }

  toPlane([px, py]: Point): Point {
    const [mx, my] = this.middle();
    return [this.center[0] + (px - mx) / this.scale, this.center[1] - (py - my) / this.scale];
  }

  /** Zoom so that the point under `at` (px) stays where it is. */
  zoom(factor: number, at: Point = this.middle()): void {
    const fitted = this.fitted();
    const before = this.toPlane(at);
    this.scale = Math.min(1e4 * fitted, Math.max(0.02 * fitted, this.scale * factor));
    const after = this.toPlane(at);
    this.center = [this.center[0] + before[0] - after[0], this.center[1] + before[1] - after[1]];
    this.moved = true;
  }

  /** Move and zoom from one state of the fingers to the next: their middle, and the distance between two. */
  follow(before: Spread, after: Spread): void {
    this.pan(after.middle[0] - before.middle[0], after.middle[1] - before.middle[1]);
    if (before.width > 0 && after.width > 0) this.zoom(after.width / before.width, after.middle);
  }

  /** The transformation to pixels as a matrix, for paths in metres. */
  matrix(): DOMMatrix {
    const [e, f] = this.toScreen([0, 0]);
    return new DOMMatrix([this.scale, 0, 0, -this.scale, e, f]);
  }

  /** Move the drawing by pixels. */
  pan(dx: number, dy: number): void {
    this.center = [this.center[0] - dx / this.scale, this.center[1] + dy / this.scale];
    this.moved = true;
  }
}
