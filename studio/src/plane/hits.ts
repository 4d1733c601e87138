// Finds the points, bodies and symbols under a place of the drawing.
import type { Body } from "../core/protocol";
import type { Item } from "../draw/items";
import { isPlaceable, placeItem, UNIT } from "../draw/place";
import { distance, distanceFromSegment, hull, type Placement, type Point, placed, within } from "./points";
import type { View } from "./view";

export interface PointHit {
  body: Body;
  point: string;
  /** Its position in the plane. */
  at: Point;
}

const REACH = 11;
const REACH_OF_TOUCH = 22;

/** The largest distance of the pointer from a hit, px. */
export function reachOf(touch: boolean): number {
  return touch ? REACH_OF_TOUCH : REACH;
}

/** All points of the mechanism, ground first. */
export function allPoints(bodies: readonly Body[], poses: readonly Placement[]): PointHit[] {
  return bodies.flatMap((body, k) => {
    const pose = poses[k];
    if (!pose) return [];
    return Object.entries(body.points).map(([point, at]) => ({ body, point, at: placed(pose, at) }));
  });
}

/** The points within reach, the nearest first. Points at one place are in the order of their bodies. */
export function pointsAt(px: Point, points: readonly PointHit[], view: View, reach: number): PointHit[] {
  const far = (hit: PointHit) => distance(view.toScreen(hit.at), px);
  const found = points.filter((hit) => far(hit) < reach);
  const least = Math.min(...found.map(far));
  return found.filter((hit) => far(hit) < least + 1);
}

/** The topmost body under a place, without ground and some others. */
export function bodyAt(
  px: Point,
  bodies: readonly Body[],
  poses: readonly Placement[],
  items: readonly Item[],
  view: View,
  reach: number,
  without: ReadonlySet<string>,
): Body | null {
  let best: { body: Body; far: number } | null = null;
  bodies.forEach((body, k) => {
    if (body.ground || without.has(body.name) || !poses[k]) return;
    const far = Math.min(farFromLinks(px, body, poses[k], view), farFromItems(px, body.name, items, poses, view));
    if (far < reach && (!best || far <= best.far)) best = { body, far };
  });
  return (best as { body: Body } | null)?.body ?? null;
}

function farFromLinks(px: Point, body: Body, pose: Placement, view: View): number {
  const points = Object.values(body.points).map((at) => view.toScreen(placed(pose, at)));
  if (!points.length) return distance(px, view.toScreen(placed(pose, body.center)));
  if (points.length === 1) return distance(px, points[0]!);
  const corners = hull(points);
  if (corners.length > 2 && within(px, corners)) return 6;
  return Math.min(...corners.map((a, k) => distanceFromSegment(px, a, corners[(k + 1) % corners.length]!)));
}

/** The distance of the painted items of an element or body from a place, px; 5 within a filled area. */
function farFromItems(
  px: Point,
  name: string,
  items: readonly Item[],
  poses: readonly Placement[],
  view: View,
): number {
  let least = Number.POSITIVE_INFINITY;
  for (const item of items) {
    if (item.of !== name || item.kind === "text" || !isPlaceable(item, poses)) continue;
    const { points } = placeItem(item, poses, view, UNIT);
    if (item.kind === "fill" && within(px, points)) least = Math.min(least, 5);
    for (let k = 1; k < points.length; k += 1)
      least = Math.min(least, distanceFromSegment(px, points[k - 1]!, points[k]!));
  }
  return least;
}

/** The element of these names whose symbol is nearest to a place, within reach. */
export function elementAt(
  px: Point,
  names: readonly string[],
  items: readonly Item[],
  poses: readonly Placement[],
  view: View,
  reach: number,
): string | null {
  let best: { name: string; far: number } | null = null;
  for (const name of names) {
    const far = farFromItems(px, name, items, poses, view);
    if (far < reach && (!best || far < best.far)) best = { name, far };
  }
  return best?.name ?? null;
}
