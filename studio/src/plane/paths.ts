// Paths of points over a run, and the choice of those that are drawn, by the rule of kempe/draw/scene.py.
import { distance, type Point } from "./points";

export interface Path {
  /** Body and point, such as `crank.A`. */
  name: string;
  body: number;
  line: Point[];
}

/** Places are equal if their distance is below this share of the size of the motion. */
const SAME_PLACE = 1e-3;
/** The number of frames that are compared to find coincident points. */
const FRAMES = 16;

/** The paths of moving points. Of coincident paths, only the first is kept. */
export function distinctPaths(all: readonly Path[]): Path[] {
  const near = SAME_PLACE * sizeOf(all.flatMap(({ line }) => line));
  const kept: Path[] = [];
  for (const path of all) {
    if (sizeOf(path.line) <= near || kept.some((other) => together(path.line, other.line, near))) continue;
    kept.push(path);
  }
  return kept;
}

function together(a: Point[], b: Point[], near: number): boolean {
  const last = a.length - 1;
  const some = Array.from({ length: FRAMES }, (_, k) => Math.round((k * last) / (FRAMES - 1)));
  return some.every((k) => distance(a[k]!, b[k]!) < near);
}

/** The larger side of the rectangle around points. */
function sizeOf(points: readonly Point[]): number {
  let [x0, y0, x1, y1] = [
    Number.POSITIVE_INFINITY,
    Number.POSITIVE_INFINITY,
    Number.NEGATIVE_INFINITY,
    Number.NEGATIVE_INFINITY,
  ];
  for (const [x, y] of points) [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
  return points.length ? Math.max(x1 - x0, y1 - y0) : 0;
}
