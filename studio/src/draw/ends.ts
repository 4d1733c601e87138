// The ends of elements. An element acts on body j, and with the opposite force on body i. Player and studio share this.
import type { Point } from "../plane/points";

/** The groups of elements with force arrows of each kind. */
export const ACTING = { reactions: ["joints"], force: ["forces", "drivers"] } as const;

/** One end of an element: the body on which it acts, the point, and the sign of the force. */
export interface End {
  element: string;
  /** The number of the body. */
  body: number;
  /** The point in the plane, m. */
  at: Point;
  sign: 1 | -1;
}

/** The ends on body j, or those on one body; `on` is the number of the body. */
export function chosenEnds<Kind extends Pick<End, "body" | "sign">>(ends: readonly Kind[], on: number | null): Kind[] {
  return ends.filter(({ body, sign }) => (on === null ? sign === 1 : body === on));
}
