// The initial form of a curve on a body, for points and rollers that move along it.
import { entry, isTable } from "../catalogue/tree";
import type { Body, Change, Tree } from "../core/protocol";
import type { Point } from "../plane/points";

export interface WithCurve {
  change: Change;
  name: string;
}

/**
 * A circle around the middle of a body through its farthest point; on the ground, a line whose body is below it, at the
 * height of the clicked place.
 */
export function curveFor(
  tree: Tree | null,
  { name: body, ground, points, center }: Body,
  step: number,
  at?: Point,
): WithCurve {
  const found = entry(tree, "bodies", body)?.curves;
  const taken = isTable(found) ? Object.keys(found) : [];
  let k = 1;
  while (taken.includes(`curve${k}`)) k += 1;
  const places = Object.values(points);
  const value = ground ? { line: lineUnder(places, step, at) } : { circle: circleAround(places, center, step) };
  return { change: { path: ["bodies", body, "curves", `curve${k}`], value }, name: `curve${k}` };
}

/** From right to left, so that other bodies are above the line. */
function lineUnder(places: readonly Point[], step: number, clicked?: Point): Point[] {
  const all = clicked ? [...places, clicked] : places.length ? places : [[0, 0]];
  const x = all.map((at) => at[0]!);
  const y = tidy(clicked ? clicked[1] : Math.min(...all.map((at) => at[1]!)));
  return [
    [tidy(Math.max(...x) + step), y],
    [tidy(Math.min(...x) - step), y],
  ];
}

function circleAround(places: readonly Point[], [x, y]: Point, step: number): number[] {
  const radius = Math.max(0, ...places.map((at) => Math.hypot(at[0] - x, at[1] - y)));
  return [tidy(x), tidy(y), tidy(radius > 0 ? radius : step / 2)];
}

function tidy(value: number): number {
  return Number(value.toPrecision(4));
}
