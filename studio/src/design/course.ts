// Where the points of a candidate are: at the poses, and while its crank turns.
import type { Candidate, Triple } from "../core/protocol";
import { inFrame, type Point, placed } from "../plane/points";

/** The pins A and B of the coupler at a pose of the task. */
export function pinsAt({ points: { A, B }, frame, points: { P } }: Candidate, pose: Triple): [Point, Point] {
  const first: Triple = [P[0], P[1], frame];
  return [placed(pose, inFrame(first, A)), placed(pose, inFrame(first, B))];
}

/** The path of the origin of the moving frame: over a full turn, or between the first and the last pose. */
export function pathOf({ points, lengths, crank_angles: angles, turns }: Candidate, count = 120): Point[] {
  const { O, A, B, D, P } = points;
  const [crank, coupler, rocker] = lengths;
  const cross = (a: Point, b: Point) => a[0] * b[1] - a[1] * b[0];
  const side = Math.sign(cross([D[0] - A[0], D[1] - A[1]], [B[0] - A[0], B[1] - A[1]])) || 1;
  const along = Math.atan2(B[1] - A[1], B[0] - A[0]);
  const own = inFrame([A[0], A[1], along], P);
  const [first, last] = [angles[0]!, turns ? angles[0]! + 2 * Math.PI : angles.at(-1)!];
  return Array.from({ length: count }, (_, k) => {
    const angle = first + ((last - first) * k) / (count - 1);
    const a: Point = [O[0] + crank * Math.cos(angle), O[1] + crank * Math.sin(angle)];
    const far = Math.hypot(D[0] - a[0], D[1] - a[1]);
    const cosine = (coupler ** 2 + far ** 2 - rocker ** 2) / (2 * coupler * far);
    const way = Math.atan2(D[1] - a[1], D[0] - a[0]) + side * Math.acos(Math.max(-1, Math.min(1, cosine)));
    return placed([a[0], a[1], way], own);
  });
}
