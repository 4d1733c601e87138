// The grip of the pointer or of the keys on a body: the body and a point of it.
import type { Body } from "../core/protocol";
import { distance, inFrame, type Point } from "../plane/points";
import { mechanism, poses, selection } from "../store/state";
import type { Spot } from "./handler";
import { bodyUnder, points, pointsUnder } from "./seen";

export interface Grip {
  body: Body;
  /** The point in the frame of the body. */
  point: Point;
}

export function gripAt(spot: Spot): Grip | null {
  const hit = pointsUnder(spot).find(({ body }) => !body.ground);
  if (hit) return { body: hit.body, point: hit.body.points[hit.point]! };
  const body = bodyUnder(spot);
  const pose = body && poses.value[mechanism.value!.bodies.indexOf(body)];
  return body && pose ? { body, point: inFrame(pose, spot.at) } : null;
}

/**
 * The grip of the keys and its position: the last point of the selected body that is not on ground;
 * without a selection, the first such point of the mechanism.
 */
export function gripOfKeys(): { grip: Grip; at: Point } | null {
  const all = points();
  const fixed = all.filter(({ body }) => body.ground);
  const free = all.filter(({ body, at }) => !body.ground && !fixed.some((one) => distance(one.at, at) < 1e-9));
  const last = free.findLast(({ body }) => body.name === selection.value?.name) ?? free[0];
  return last ? { grip: { body: last.body, point: last.body.points[last.point]! }, at: last.at } : null;
}
