// A picture behind the drawing. It is not a part of the text, but belongs to the opened case.
import { effect, signal } from "@preact/signals";
import { distance, type Point } from "../plane/points";
import { openings } from "./state";

export interface Backdrop {
  image: HTMLImageElement;
  /** Its middle, m, about which it is turned. */
  center: Point;
  /** rad, counter-clockwise. */
  angle: number;
  /** Metres of one of its pixels. */
  scale: number;
  opacity: number;
}

export const backdrop = signal<Backdrop | null>(null);
/** Whether drags move the picture. */
export const shifting = signal(false);
/** The clicked points while the picture is scaled; otherwise null. */
export const scaling = signal<Point[] | null>(null);

/** Scale the picture about the first of two points, so that their distance has a given value. */
export function scaleTo(length: number): void {
  const found = backdrop.value;
  const [a, b] = scaling.value ?? [];
  scaling.value = null;
  if (!found || !a || !b || !(distance(a, b) > 0) || !(length > 0)) return;
  const factor = length / distance(a, b);
  const center = found.center.map((value, k) => a[k]! + factor * (value - a[k]!)) as Point;
  backdrop.value = { ...found, center, scale: factor * found.scale };
}

/** The pictures of other cases, which undo may bring back. */
const others = new Map<number, Backdrop | null>();
let shown = openings.peek();

effect(() => {
  if (openings.value === shown) return;
  others.set(shown, backdrop.peek());
  shown = openings.value;
  backdrop.value = others.get(shown) ?? null;
  shifting.value = false;
});
