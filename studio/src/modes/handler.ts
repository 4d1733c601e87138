// What a mode does with the pointer.
import type { Point } from "../plane/points";

export interface Spot {
  /** In the canvas, px, and in the plane, m. */
  px: Point;
  at: Point;
  touch: boolean;
  /** With a key that switches snapping off. */
  free: boolean;
}

export interface Handler {
  /** A press; true if the handler takes the drag, otherwise the sheet is moved. */
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
