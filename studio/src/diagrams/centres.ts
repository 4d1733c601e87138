// Instantaneous centres of velocity: seen from body i, body j turns about the point P where both have the same velocity. With
// the differences Δu of their velocities at a place, and Δω of their rates, P = place + B Δu / Δω, where B turns by 90°.
import type { Instant } from "../core/protocol";
import type { Point } from "../plane/points";
import { minus, placeOf, plus, seenFrom, size, times, turned, velocityAt } from "./points";

/** A centre is at infinity if its distance exceeds the size of the mechanism by this factor. */
const FAR = 1e12;
/** Bodies are at rest against each other below this fraction of the speed of the fastest body. */
const STILL = 1e-13;

export interface Centre {
  i: number;
  j: number;
  /** Its place, m; null at infinity, where the relative motion is a translation. */
  at: Point | null;
  /** The unit vector from the middle of the mechanism to the centre. */
  direction: Point;
}

/** The middle of the mechanism and its size, m. `points` are the named points of each body. */
export function extent(
  { bodies }: Pick<Instant, "bodies">,
  points: readonly Point[][],
): { middle: Point; size: number } {
  const places = bodies.flatMap((body, b) => {
    const own = points[b] ?? [];
    return (b ? [[0, 0] as Point, ...own] : own).map((s) => placeOf(body, s));
  });
  const along = (axis: 0 | 1) => {
    const all = places.map((at) => at[axis]);
    return [Math.min(...all), Math.max(...all)] as const;
  };
  const [[x0, x1], [y0, y1]] = places.length ? [along(0), along(1)] : [[0, 0] as const, [0, 0] as const];
  return { middle: [(x0 + x1) / 2, (y0 + y1) / 2], size: Math.max(x1 - x0, y1 - y0) || 1 };
}

/** The centre of body j seen from body i; null if the bodies are at rest against each other. */
export function centreOf(
  { bodies }: Pick<Instant, "bodies">,
  i: number,
  j: number,
  { middle, size: large }: { middle: Point; size: number },
): Centre | null {
  const speeds = bodies.map((body) => size(velocityAt(body, middle)) + Math.abs(body.rate[2]) * large);
  const fastest = Math.max(...speeds);
  const u = minus(velocityAt(bodies[j]!, middle), velocityAt(bodies[i]!, middle));
  const w = bodies[j]!.rate[2] - bodies[i]!.rate[2];
  const speed = size(u);
  if (speed <= STILL * fastest && Math.abs(w) * large <= STILL * fastest) return null;
  const far = Math.abs(w) * FAR * large <= speed;
  const away = times(w < 0 ? -1 : 1, turned(u));
  return {
    i,
    j,
    at: far ? null : plus(middle, times(1 / w, turned(u))),
    direction: speed > 0 ? times(1 / speed, away) : [1, 0],
  };
}

/** The centres of all pairs of bodies in relative motion, or of the pairs with one body. */
export function centresOf(instant: Instant, points: readonly Point[][], from: number | null): Centre[] {
  const all = extent(instant, points);
  const numbers = instant.bodies.map((_, b) => b);
  const pairs = numbers.flatMap((i) => numbers.slice(i + 1).map((j): [number, number] => [i, j]));
  const wanted = pairs.filter(([i, j]) => from === null || i === from || j === from);
  return wanted.flatMap(([i, j]) => centreOf(instant, i, j, all) ?? []);
}

/** The path of the centre in the frame of a body of the pair; null where it is at infinity or does not exist. */
export function centrode(
  motion: readonly Pick<Instant, "bodies">[],
  points: readonly Point[][],
  [i, j]: readonly [number, number],
  on: number,
): (Point | null)[] {
  return motion.map((instant) => {
    const at = centreOf(instant, i, j, extent(instant, points))?.at;
    return at ? seenFrom(instant.bodies[on]!, at) : null;
  });
}
