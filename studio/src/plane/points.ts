// Points of the plane and poses of bodies.

export type Point = [number, number];
/** x, y and angle of a body. */
export type Placement = readonly [number, number, number];

/** The global position of a point of a body with this pose. */
export function placed([x, y, angle]: Placement, [a, b]: Point): Point {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [x + cos * a - sin * b, y + sin * a + cos * b];
}

/** A global point in the frame of a body with this pose. */
export function inFrame([x, y, angle]: Placement, [px, py]: Point): Point {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const [dx, dy] = [px - x, py - y];
  return [cos * dx + sin * dy, cos * dy - sin * dx];
}

export function distance([ax, ay]: Point, [bx, by]: Point): number {
  return Math.hypot(bx - ax, by - ay);
}

/** Distance of a point from the segment between two others. */
export function distanceFromSegment(p: Point, a: Point, b: Point): number {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const square = dx * dx + dy * dy;
  const share = square > 0 ? ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square : 0;
  const s = Math.min(1, Math.max(0, share));
  return distance(p, [a[0] + s * dx, a[1] + s * dy]);
}

/** A length rounded to `digits` significant digits of a scale, which removes rounding errors. */
export function rounded(value: number, step: number): number {
  if (!(step > 0)) return value;
  const decimals = Math.max(0, Math.min(12, 1 - Math.floor(Math.log10(step))));
  return Number(value.toFixed(decimals)) + 0; // + 0 removes the sign of zero
}

/** The convex hull of points, counter-clockwise (Andrew's monotone chain). */
export function hull(points: Point[]): Point[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  if (sorted.length < 3) return sorted;
  const half = (list: Point[]) => {
    const chain: Point[] = [];
    for (const p of list) {
      while (chain.length > 1 && turn(chain[chain.length - 2]!, chain[chain.length - 1]!, p) <= 0) chain.pop();
      chain.push(p);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

function turn(a: Point, b: Point, c: Point): number {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/** Whether a point is within a polygon (even-odd rule). */
export function within([x, y]: Point, corners: Point[]): boolean {
  let inside = false;
  corners.forEach(([ax, ay], k) => {
    const [bx, by] = corners[(k + 1) % corners.length]!;
    if (ay > y !== by > y && x < ((bx - ax) * (y - ay)) / (by - ay) + ax) inside = !inside;
  });
  return inside;
}
