// The display list: items that follow bodies; docs/scene.md describes them.
import type { Point } from "../plane/points";

export type Frame =
  | { type: "body"; body: number; at: Point; turns_with: number; turn: number }
  | { type: "line" | "ray"; bodies: [number, number]; ends: [Point, Point]; room?: number }
  | { type: "twist"; bodies: [number, number]; at: Point; turn: number };

interface Common {
  of: string;
  layer: number;
  frame: Frame;
  /** Rows [x, y, px, py]: metres (or shares) and points of print. */
  points: [number, number, number, number][];
  colour: string;
  tint: number;
  numbered?: boolean;
}

export type Item = Common &
  (
    | { kind: "fill" }
    | { kind: "line"; width: number; closed: boolean; hatch: number }
    | {
        kind: "text";
        text: string;
        role: string;
        size: number;
        weight: string;
        slanted: boolean;
        turned: boolean;
        offset: Point;
      }
  );
