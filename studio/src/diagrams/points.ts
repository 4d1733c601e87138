// Places, velocities and accelerations of points of bodies at one instant. Bodies have the numbers of the core; ground is 0.
import type { Instant } from "../core/protocol";
import { inFrame, type Point, placed } from "../plane/points";

export const plus = ([a, b]: Point, [c, d]: Point): Point => [a + c, b + d];
export const minus = ([a, b]: Point, [c, d]: Point): Point => [a - c, b - d];
export const times = (k: number, [a, b]: Point): Point => [k * a, k * b];
/** A vector turned by 90°. */
export const turned = ([a, b]: Point): Point => [-b, a];
export const dot = ([a, b]: Point, [c, d]: Point): number => a * c + b * d;
export const cross = ([a, b]: Point, [c, d]: Point): number => a * d - b * c;
export const size = ([a, b]: Point): number => Math.hypot(a, b);

type Body = Instant["bodies"][number];

/** The place of a point s of a body. */
export function placeOf({ pose }: Body, s: Point): Point {
  return placed(pose, s);
}

/** Coordinates of a place in the frame of a body. */
export function seenFrom({ pose }: Body, at: Point): Point {
  return inFrame(pose, at);
}

/** The velocity of the point of a body at a place: v + ω × r. */
export function velocityAt({ pose, rate }: Body, at: Point): Point {
  return plus([rate[0], rate[1]], times(rate[2], turned(minus(at, [pose[0], pose[1]]))));
}

/** The acceleration of the point of a body at a place: a + α × r - ω² r; NaN where it is not unique. */
export function accelerationAt({ pose, rate, acceleration }: Body, at: Point): Point {
  const [ax, ay, alpha] = acceleration ?? [Number.NaN, Number.NaN, Number.NaN];
  const r = minus(at, [pose[0], pose[1]]);
  return plus(plus([ax, ay], times(alpha, turned(r))), times(-(rate[2] ** 2), r));
}
