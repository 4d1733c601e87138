// Finds the nearest common point of circles and of lines through the origin.
import { distance, type Point } from "./points";

/** A circle, or the line through the origin along a vector. */
export type Curve = { center: Point; radius: number } | { along: Point };

/** The tolerance, relative to the size of the curves. */
const TOLERANCE = 1e-9;

/** The common point of all curves that is nearest to a wanted point; null if there is none. */
export function nearestOnAll(wanted: Point, curves: readonly Curve[]): Point | null {
  const [first, ...others] = curves;
  if (!first) return wanted;
  const size = Math.max(...curves.map((one) => ("along" in one ? Math.hypot(...one.along) : one.radius)));
  const isOn = (at: Point, curve: Curve) => distance(at, nearest(at, curve)) <= TOLERANCE * size;
  const different = others.find((other) => !isSame(first, other, TOLERANCE * size));
  const candidates = different ? meets(first, different, TOLERANCE * size) : [nearest(wanted, first)];
  const common = candidates.filter((at) => curves.every((curve) => isOn(at, curve)));
  return common.sort((a, b) => distance(a, wanted) - distance(b, wanted))[0] ?? null;
}

function isSame(a: Curve, b: Curve, tolerance: number): boolean {
  if ("along" in a || "along" in b) {
    if (!("along" in a && "along" in b)) return false;
    const [long, other] = [Math.hypot(...a.along), Math.hypot(...b.along)];
    return Math.abs(a.along[0] * b.along[1] - a.along[1] * b.along[0]) <= tolerance * Math.min(long, other);
  }
  return distance(a.center, b.center) <= tolerance && Math.abs(a.radius - b.radius) <= tolerance;
}

/** The point of a curve that is nearest to another point. */
function nearest([x, y]: Point, curve: Curve): Point {
  if ("along" in curve) {
    const [ax, ay] = curve.along;
    const share = (x * ax + y * ay) / (ax * ax + ay * ay);
    return [share * ax, share * ay];
  }
  const { center, radius } = curve;
  const far = distance([x, y], center);
  if (far === 0) return [center[0] + radius, center[1]];
  const share = radius / far;
  return [center[0] + share * (x - center[0]), center[1] + share * (y - center[1])];
}

/** The common points of two different curves. Curves touch if the gap between them is below the tolerance. */
function meets(a: Curve, b: Curve, tolerance: number): Point[] {
  if ("along" in a) return "along" in b ? [[0, 0]] : onLine(b, a.along, tolerance);
  if ("along" in b) return onLine(a, b.along, tolerance);
  const gap = distance(a.center, b.center);
  if (gap <= tolerance) return [];
  // The common chord crosses the line of the centres at this distance from the first.
  const along = (gap * gap + a.radius ** 2 - b.radius ** 2) / (2 * gap);
  const [ux, uy] = [(b.center[0] - a.center[0]) / gap, (b.center[1] - a.center[1]) / gap];
  const middle: Point = [a.center[0] + along * ux, a.center[1] + along * uy];
  return bothSides(middle, [-uy, ux], a.radius, along, tolerance);
}

function onLine({ center, radius }: { center: Point; radius: number }, along: Point, tolerance: number): Point[] {
  const middle = nearest(center, { along });
  const long = Math.hypot(...along);
  return bothSides(middle, [along[0] / long, along[1] / long], radius, distance(middle, center), tolerance);
}

/** The ends of a chord of a circle, from its middle, its direction and its distance from the centre. */
function bothSides([x, y]: Point, [dx, dy]: Point, radius: number, far: number, tolerance: number): Point[] {
  if (Math.abs(far) > radius + tolerance) return [];
  const half = Math.sqrt(Math.max(0, radius * radius - far * far));
  return [
    [x + half * dx, y + half * dy],
    [x - half * dx, y - half * dy],
  ];
}
