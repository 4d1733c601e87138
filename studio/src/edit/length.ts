// A new length for a body that is placed by two points. One point moves, with all points that are pinned there.

import { nearestOnAll } from "../plane/curves";
import type { PointHit } from "../plane/hits";
import { distance, type Point } from "../plane/points";

const SAME = 1e-9;

/** The new position of an end of a body, and the points that move with it. */
export interface Moving {
  hits: PointHit[];
  to: Point;
  /** Whether the lengths of the bodies that are pinned there stay. */
  kept: boolean;
}

/** The end that moves is not fixed to ground, if possible; other bodies keep their lengths, if possible. */
export function lengthened(name: string, length: number, all: readonly PointHit[]): Moving | null {
  const ends = all.filter(({ body }) => body.name === name);
  if (ends.length < 2 || !(length > 0)) return null;
  const at = (place: Point) => all.filter((hit) => distance(hit.at, place) < SAME);
  const isFree = (hit: PointHit) => !at(hit.at).some(({ body }) => body.ground);
  const end = ends.slice(0, 2).findLast(isFree) ?? ends[1]!;
  const from = ends.find((one) => one !== end)!.at;
  const before = distance(from, end.at);
  if (before === 0) return null;
  const hits = at(end.at);
  const circle = { center: from, radius: length };
  const straight: Point = [0, 1].map((k) => from[k]! + (length / before) * (end.at[k]! - from[k]!)) as Point;
  const neighbours = hits.filter(({ body }) => body.name !== name && !body.ground);
  const others = neighbours.flatMap(({ body }) =>
    all.filter((hit) => hit.body.name === body.name && !hits.includes(hit)),
  );
  const kept = others.map((other) => ({ center: other.at, radius: distance(other.at, end.at) }));
  // The position nearest to the end keeps the mechanism on its branch.
  const to = nearestOnAll(end.at, [circle, ...kept]);
  return to && others.length ? { hits, to, kept: true } : { hits, to: straight, kept: !others.length };
}
