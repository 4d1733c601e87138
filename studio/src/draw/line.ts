// Paths that keep their text, so that the same painting makes pixels and SVG.
import type { Point } from "../plane/points";

/** A path of the canvas with its text in the notation of SVG. */
export class Line extends Path2D {
  constructor(readonly text: string) {
    super(text);
  }
}

/** A line through points. */
export function through(points: readonly Point[], closed: boolean): Line {
  const text = points.map(([x, y], k) => `${k ? "L" : "M"}${x} ${y}`).join("");
  return new Line(closed && points.length ? `${text}Z` : text);
}

export function circle([x, y]: Point, radius: number): Line {
  return new Line(
    `M${x - radius} ${y}a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0z`,
  );
}
