// The sheet: which part of the plane is seen, and what is drawn over the mechanism.
import { effect, signal } from "@preact/signals";
import type { Point } from "../plane/points";
import { View } from "../plane/view";
import { scene } from "./state";

export const view = new View([-1, -0.75, 1, 0.75]);
/** Counts changes of the view, so that the drawing follows. */
export const viewed = signal(0);

/** A line that is being drawn, or a place under the pointer. */
export interface Preview {
  /** Points of the plane, joined by lines. */
  line: Point[];
  closed?: boolean;
  /** The marked place, and why it is there. */
  mark?: { at: Point; kind: string };
  label?: string;
  /** A pull from one point to another. */
  pull?: [Point, Point];
}

export const preview = signal<Preview | null>(null);
/** A length that was typed for the line that is being drawn, m. */
export const typedLength = signal<string>("");

export function viewChanged(): void {
  viewed.value += 1;
}

export function fit(): void {
  view.fit();
  viewChanged();
}

export function zoom(factor: number): void {
  view.zoom(factor);
  viewChanged();
}

/** The bounds of a new scene; the view follows unless it was moved by hand. */
effect(() => {
  const bounds = scene.value?.bounds;
  if (!bounds?.every(Number.isFinite)) return;
  const [x0, y0, x1, y1] = bounds;
  if (x1 - x0 <= 0 && y1 - y0 <= 0) return;
  view.bounds = bounds;
  if (!view.moved) view.fit();
  viewed.value = viewed.peek() + 1;
});
