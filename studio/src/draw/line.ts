// Paths that keep their text, so that the same painting makes pixels and SVG.
import type { Point } from "../plane/points";

/** A path of the canvas, with its text in the notation of SVG; the text is made on demand. */
export class Line extends Path2D {
  private readonly written: () => string;

  constructor(text: string | (() => string)) {
    super(typeof text === "string" ? text : undefined);
    this.written = typeof text === "string" ? () => text : text;
  }

  get text(): string {
    return this.written();
  }
}

/** A line through points. */
export function through(points: readonly Point[], closed: boolean): Line {
  const ends = closed && points.length > 0;
  const line = new Line(() => points.map(([x, y], k) => `${k ? "L" : "M"}${x} ${y}`).join("") + (ends ? "Z" : ""));
  points.forEach(([x, y], k) => (k ? line.lineTo(x, y) : line.moveTo(x, y)));
  if (ends) line.closePath();
  return line;
}

/** Lines through points, with a gap at each missing point. */
export function broken(points: readonly (Point | null)[]): Line {
  const starts = (k: number) => !points[k - 1];
  const line = new Line(() => points.map((at, k) => (at ? `${starts(k) ? "M" : "L"}${at[0]} ${at[1]}` : "")).join(""));
  points.forEach((at, k) => {
    if (at) starts(k) ? line.moveTo(...at) : line.lineTo(...at);
  });
  return line;
}

export function circle([x, y]: Point, radius: number): Line {
  return new Line(
    `M${x - radius} ${y}a${radius} ${radius} 0 1 0 ${2 * radius} 0a${radius} ${radius} 0 1 0 ${-2 * radius} 0z`,
  );
}
