// Points, lengths and angles that are held while the drawing is changed.

import { type Curve, nearestOnAll } from "../plane/curves";
import type { PointHit } from "../plane/hits";
import { distance, type Point } from "../plane/points";

/** Points of the drawing that move together, at one place. */
export interface Place {
  at: Point;
  hits: readonly PointHit[];
}

export const ofPoint = (body: string, point: string) => `point ${body}.${point}`;
export const ofLengths = (body: string) => `lengths ${body}`;
export const ofAngle = (body: string) => `angle ${body}`;

/** A shift below this share of the wanted shift is a rounding error. */
const ROUNDING = 1e-9;

/** The shift that keeps everything held and is nearest to the wanted shift. */
export function heldShift(
  wanted: Point,
  places: readonly Place[],
  all: readonly PointHit[],
  held: ReadonlySet<string>,
): Point {
  if (places.some(({ hits }) => hits.some(({ body, point }) => held.has(ofPoint(body.name, point))))) return [0, 0];
  const moving = new Set(places.flatMap(({ hits }) => hits));
  const curves = places.flatMap((place) => place.hits.flatMap((hit) => curvesOf(hit, place.at, all, moving, held)));
  const shift = nearestOnAll(wanted, curves) ?? [0, 0];
  return Math.hypot(...shift) > ROUNDING * Math.hypot(...wanted) ? shift : [0, 0];
}

function curvesOf(
  { body }: PointHit,
  at: Point,
  all: readonly PointHit[],
  moving: ReadonlySet<PointHit>,
  held: ReadonlySet<string>,
): Curve[] {
  const still = all.filter((other) => other.body.name === body.name && !moving.has(other));
  const away = still.filter((other) => distance(other.at, at) > 0);
  const steps = away.map((other): Point => [other.at[0] - at[0], other.at[1] - at[1]]);
  return [
    ...(held.has(ofLengths(body.name)) ? steps.map((center) => ({ center, radius: Math.hypot(...center) })) : []),
    ...(held.has(ofAngle(body.name)) ? steps.map((along) => ({ along })) : []),
  ];
}
