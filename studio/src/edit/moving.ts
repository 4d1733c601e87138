// Changes of the text that move a place of the drawing, with all points that are pinned there.

import { entry, isTable } from "../catalogue/tree";
import type { Change, Tree, Value } from "../core/protocol";
import type { PointHit } from "../plane/hits";
import { inFrame, type Placement, type Point, rounded } from "../plane/points";

/** A point that cannot be moved: a formula or a length determines it. */
export interface Fixed {
  body: string;
  point: string;
}

export interface Moved {
  changes: Change[];
  fixed: Fixed[];
}

/** The changes that bring all these points, which are at one place, to another place. */
export function moved(
  tree: Tree | null,
  hits: readonly PointHit[],
  placements: readonly Placement[],
  bodies: readonly { name: string }[],
  to: Point,
): Moved {
  const result: Moved = { changes: [], fixed: [] };
  for (const hit of hits) {
    const pose = placements[bodies.findIndex(({ name }) => name === hit.body.name)];
    if (pose) moveOne(tree, hit, pose, to, result);
  }
  return result;
}

function moveOne(
  tree: Tree | null,
  { body, point }: PointHit,
  pose: Placement,
  to: Point,
  { changes, fixed }: Moved,
): void {
  const base = ["bodies", body.name];
  const found = entry(tree, "bodies", body.name);
  const through = table(found?.through);
  const points = table(found?.points);
  if (found && "at" in found) {
    if (isPlain(found.at)) changes.push({ path: [...base, "at"], value: to });
    else fixed.push({ body: body.name, point });
    return;
  }
  const inThrough = through && point in through;
  const inPoints = points && point in points;
  if ((inThrough && !isPlain(through[point])) || (inPoints && !isPlain(points[point])) || !(inThrough || inPoints)) {
    fixed.push({ body: body.name, point });
    return;
  }
  if (inThrough) changes.push({ path: [...base, "through", point], value: to });
  if (inPoints) changes.push({ path: [...base, "points", point], value: body.ground ? to : local(pose, to) });
}

function local(pose: Placement, to: Point): Point {
  const [x, y] = inFrame(pose, to);
  const step = Math.max(Math.abs(x), Math.abs(y), 1e-9) * 1e-9;
  return [rounded(x, step), rounded(y, step)];
}

/** The changes that give a body the present positions of its ends instead of a length. */
export function drawnThrough(tree: Tree | null, hits: readonly PointHit[], name: string): Change[] {
  const found = entry(tree, "bodies", name);
  const base = ["bodies", name];
  const ends = hits.filter(({ body }) => body.name === name).slice(0, 2);
  if (!found || ends.length < 2) return [];
  const value = Object.fromEntries(ends.map(({ point, at }) => [point, [rounded(at[0], 1e-9), rounded(at[1], 1e-9)]]));
  const removed = ["length", "ends"].filter((key) => key in found);
  return [
    ...removed.map((key): Change => ({ path: [...base, key], remove: true })),
    { path: [...base, "through"], value },
  ];
}

/** Whether a pair consists of numbers, not formulas. */
export function isPlain(value: Value | undefined): boolean {
  return Array.isArray(value) && value.every((one) => typeof one === "number");
}

function table(value: Value | undefined): Tree | null {
  return isTable(value) ? value : null;
}
