// Snaps a new point to an existing point, to a link, to the grid, or to a line at a round angle.
import { distance, type Point, rounded } from "./points";

/** Lines snap to multiples of this angle, rad. */
const TURN = Math.PI / 12;
/** The largest distance from an existing point, and from a line at a round angle, at which a point snaps to it, px. */
const REACH = 12;
const REACH_OF_ANGLE = 7;

export interface Snapping {
  /** Existing points of the plane. */
  points: readonly Point[];
  /** Links of bodies, on which a point may lie. */
  lines?: readonly (readonly [Point, Point])[];
  /** The step of the grid, m. */
  step: number;
  /** Pixels per metre. */
  scale: number;
  /** The other end of the line in progress. */
  from?: Point | undefined;
  /** A typed length, m. */
  length?: number | undefined;
  /** Whether the point snaps to existing points only. */
  free?: boolean;
}

export interface Snapped {
  at: Point;
  kind: "point" | "line" | "angle" | "grid" | "free" | "length";
}

/** The place for a point near `p`. */
export function snapped(p: Point, { points, lines = [], step, scale, from, length, free }: Snapping): Snapped {
  if (from && length !== undefined) return { at: atLength(p, from, length), kind: "length" };
  const near = nearest(p, points);
  if (near && distance(p, near) * scale < REACH) return { at: clean(near, step), kind: "point" };
  if (free) return { at: [rounded(p[0], step / 100), rounded(p[1], step / 100)], kind: "free" };
  const on = nearest(
    p,
    lines.map(([a, b]) => nearestOn(p, a, b)),
  );
  if (on && distance(p, on) * scale < REACH_OF_ANGLE) return { at: clean(on, step), kind: "line" };
  const grid: Point = [round(p[0], step), round(p[1], step)];
  const angled = from && atAngle(p, from, step);
  if (angled && distance(p, angled) * scale < REACH_OF_ANGLE && distance(p, angled) < distance(p, grid)) {
    return { at: angled, kind: "angle" };
  }
  return { at: grid, kind: "grid" };
}

/** A place, rounded to remove the errors of the pose from which it was computed. */
function clean([x, y]: Point, step: number): Point {
  return [rounded(x, step * 1e-6), rounded(y, step * 1e-6)];
}

function nearestOn(p: Point, a: Point, b: Point): Point {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const share = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy || 1);
  const s = Math.min(1, Math.max(0, share));
  return [a[0] + s * dx, a[1] + s * dy];
}

function nearest(p: Point, points: readonly Point[]): Point | null {
  let best: Point | null = null;
  for (const other of points) if (!best || distance(p, other) < distance(p, best)) best = other;
  return best;
}

/** A multiple of a step, without the rounding errors of the product. */
function round(value: number, step: number): number {
  return rounded(Math.round(value / step) * step, step);
}

/** The point in the same direction at a typed length; the direction turns to the nearest multiple of 15°. */
function atLength(p: Point, from: Point, length: number): Point {
  const angle = Math.atan2(p[1] - from[1], p[0] - from[0]);
  const near = Math.round(angle / TURN) * TURN;
  return turned(from, length, Math.abs(angle - near) < 0.07 ? near : angle);
}

/** The point on the nearest line at a multiple of 15° whose length is a multiple of the step. */
function atAngle(p: Point, from: Point, step: number): Point {
  const angle = Math.round(Math.atan2(p[1] - from[1], p[0] - from[0]) / TURN) * TURN;
  return turned(from, round(distance(p, from), step), angle);
}

function turned([x, y]: Point, length: number, angle: number): Point {
  const step = length * 1e-6;
  return [rounded(x + length * Math.cos(angle), step), rounded(y + length * Math.sin(angle), step)];
}
