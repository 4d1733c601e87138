// A picture behind the drawing. It is not a part of the case.
import { signal } from "@preact/signals";
import { distance, type Point } from "../plane/points";

export interface Backdrop {
  image: HTMLImageElement;
  /** Its upper left corner, m. */
  corner: Point;
  /** Metres of one of its pixels. */
  scale: number;
  opacity: number;
}

export const backdrop = signal<Backdrop | null>(null);
/** The clicked points while the picture is scaled; otherwise null. */
export const scaling = signal<Point[] | null>(null);

/** Scale the picture about the first of two points, so that their distance has a given value. */
export function scaleTo(length: number): void {
  const found = backdrop.value;
  const [a, b] = scaling.value ?? [];
  scaling.value = null;
  if (!found || !a || !b || !(distance(a, b) > 0) || !(length > 0)) return;
  const factor = length / distance(a, b);
  const corner = found.corner.map((value, k) => a[k]! + factor * (value - a[k]!)) as Point;
  backdrop.value = { ...found, corner, scale: factor * found.scale };
}
