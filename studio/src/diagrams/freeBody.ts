// A body with all loads on it and its inertia: Σ F = m a of the mass centre, and Σ M = J α about the mass centre.
import type { Instant, Load } from "../core/protocol";
import type { Point } from "../plane/points";
import { accelerationAt, cross, minus, placeOf, plus, size, times } from "./points";

export interface FreeBody {
  loads: Load[];
  centre: Point;
  /** m a, N, and J α, N·m. */
  force: Point;
  moment: number;
  /** The largest error of both equations, relative to the largest force and the largest moment. */
  error: number;
}

/** The body with this number; null for ground, and where loads or accelerations are not unique. */
export function freeBodyOf({ bodies, loads }: Instant, number: number): FreeBody | null {
  const body = bodies[number];
  if (!number || !body?.acceleration || !loads) return null;
  const own = loads.filter((load) => load.body === number);
  const centre = placeOf(body, body.center);
  const force = times(body.mass, accelerationAt(body, centre));
  const moment = body.inertia * body.acceleration[2];
  const arms = own.map((load) => cross(minus(load.place, centre), load.force));
  const left = own.reduce((sum, load) => plus(sum, load.force), times(-1, force));
  const turning = own.reduce((sum, load, k) => sum + load.moment + arms[k]!, -moment);
  const largest = Math.max(size(force), ...own.map((load) => size(load.force)));
  const reach = own.map((load) => size(minus(load.place, centre)) * size(load.force));
  const most = Math.max(Math.abs(moment), ...reach, ...own.map((load) => Math.abs(load.moment)));
  const share = (error: number, of: number) => (of > 0 ? error / of : 0);
  return {
    loads: own,
    centre,
    force,
    moment,
    error: Math.max(share(size(left), largest), share(Math.abs(turning), most)),
  };
}
