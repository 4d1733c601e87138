// The actions of a mode for the pointer.
import type { Point } from "../plane/points";

export interface Spot {
  /** The position in the canvas, px, and in the plane, m. */
  px: Point;
  at: Point;
  touch: boolean;
  /** Whether a key switches snapping off. */
  free: boolean;
}

export interface Handler {
  /** A press. If the result is true, the handler gets the drag; otherwise the drag moves the sheet. */
  down?(spot: Spot): boolean;
  drag?(spot: Spot): void;
  up?(spot: Spot): void;
  cancel?(): void;
  /** A press and release at one place. */
  click?(spot: Spot): void;
  double?(spot: Spot): boolean;
  hover?(spot: Spot | null): void;
  cursor?(): string;
}
