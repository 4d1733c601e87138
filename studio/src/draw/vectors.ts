// Arrows of forces, velocities and accelerations, with their magnitudes.
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { paintArrow } from "./arrow";
import { quantity } from "./numbers";
import { type Colours, font, rimmed } from "./surface";

export interface Vector {
  name: string;
  at: Point;
  value: Point;
}

export interface VectorKind {
  colour: string;
  unit: string;
  /** Length of the arrow of the largest value is this share of the drawing. */
  largest: number;
  vectors: Vector[];
}

const LONGEST = 0.2;
const SHORTEST = 3;

/** Arrows of one kind; the largest value over the run has a fifth of the size of the drawing. */
export function paintVectors(
  context: CanvasRenderingContext2D,
  view: View,
  { colour, unit, largest, vectors }: VectorKind,
  colours: Colours,
): void {
  if (!(largest > 0)) return;
  const pixels = (LONGEST * Math.min(view.width, view.height)) / largest;
  context.textBaseline = "middle";
  for (const { name, at, value } of vectors) {
    const size = Math.hypot(...value);
    if (!(size * pixels > SHORTEST)) continue;
    const from = view.toScreen(at);
    const to: Point = [from[0] + value[0] * pixels, from[1] - value[1] * pixels];
    paintArrow(context, from, to, colours.named[colour]!, 2.4, colours.named.panel!);
    context.font = font(12);
    context.textAlign = to[0] < from[0] ? "right" : "left";
    const beside = to[0] < from[0] ? -6 : 6;
    rimmed(
      context,
      `${name} ${quantity(size, unit)}`,
      [to[0] + beside, to[1]],
      colours.named[colour]!,
      colours.named.panel!,
    );
  }
}
