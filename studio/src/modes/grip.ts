// Taking hold of a body: the body and its point under the pointer.
import type { Body } from "../core/protocol";
import { inFrame, type Point } from "../plane/points";
import { mechanism, poses } from "../store/state";
import type { Spot } from "./handler";
import { bodyUnder, pointsUnder } from "./seen";

export interface Grip {
  body: Body;
  /** In the frame of the body. */
  point: Point;
}

export function gripAt(spot: Spot): Grip | null {
  const hit = pointsUnder(spot).find(({ body }) => !body.ground);
  if (hit) return { body: hit.body, point: hit.body.points[hit.point]! };
  const body = bodyUnder(spot);
  const pose = body && poses.value[mechanism.value!.bodies.indexOf(body)];
  return body && pose ? { body, point: inFrame(pose, spot.at) } : null;
}
