// The sheet: the visible part of the plane, and the marks above the mechanism.
import { effect, signal } from "@preact/signals";
import type { Point } from "../plane/points";
import { type Bounds, View } from "../plane/view";
import { scene } from "./state";

export const view = new View([-1, -0.75, 1, 0.75]);
/** Counts changes of the view, so that the drawing follows. */
export const viewed = signal(0);

/** The line in progress, or the place under the pointer. */
export interface Preview {
  /** Points of the plane, joined by lines. */
  line: Point[];
  closed?: boolean;
  /** The marked place, and the reason for it. */
  mark?: { at: Point; kind: string };
  label?: string;
  /** A pull from one point to another. */
  pull?: [Point, Point];
}

export const preview = signal<Preview | null>(null);
/** The typed length of the line in progress, m. */
export const typedLength = signal<string>("");

/** A key moves the sheet by this distance, px. */
const STEP = 60;

export function viewChanged(): void {
  viewed.value += 1;
}

export function fit(): void {
  view.fit();
  viewChanged();
}

/** Show everything, and points beside the mechanism. */
export function fitWith(points: readonly Point[]): void {
  const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
  const [x0, y0, x1, y1] = view.bounds;
  const least = (all: number[], from: number) => all.reduce((a, b) => Math.min(a, b), from);
  const most = (all: number[], from: number) => all.reduce((a, b) => Math.max(a, b), from);
  view.bounds = [least(xs, x0), least(ys, y0), most(xs, x1), most(ys, y1)];
  fit();
}

/** Draw a motion with `draw`, and show all of it if all of the mechanism was in view before. */
export async function fitMotion(draw: () => Promise<void>): Promise<void> {
  const whole = inView();
  await draw();
  if (whole && !inView()) fit();
}

/** Whether all of the scene is in view. */
function inView(): boolean {
  const [x0, y0, x1, y1] = scene.peek()?.bounds ?? [0, 0, 0, 0];
  const [[left, bottom], [right, top]] = [view.toScreen([x0, y0]), view.toScreen([x1, y1])];
  return left >= 0 && top >= 0 && right <= view.width && bottom <= view.height;
}

export function zoom(factor: number): void {
  view.zoom(factor);
  viewChanged();
}

/** Show more of the plane in a direction. */
export function pan(dx: number, dy: number): void {
  view.pan(-STEP * dx, STEP * dy);
  viewChanged();
}

/** Room for the motion around the first pose, as a share of its size. */
const ROOM = 0.2;
/** The visible part of an empty sheet, m. */
const EMPTY: Bounds = [-1, -0.75, 1, 0.75];
let fitting = true;
/** The view that replaces the fitted one, because it was kept: its middle, and its scale as a multiple of the fitted one. */
let kept: { center: Point; zoom: number } | null = null;

/** Fit the next scene into the view, because another case is opened. Later scenes do not change the view. */
export function fitNext(): void {
  fitting = true;
  view.bounds = EMPTY;
}

/** Show the next scene in this view. */
export function viewNext(shown: typeof kept): void {
  kept = shown;
}

effect(() => {
  const bounds = scene.value?.bounds;
  if (!bounds?.every(Number.isFinite)) return;
  const [x0, y0, x1, y1] = bounds;
  const room = ROOM * Math.max(x1 - x0, y1 - y0);
  const before = view.bounds;
  if (room > 0) view.bounds = [x0 - room, y0 - room, x1 + room, y1 + room];
  if (fitting) {
    view.fit();
    if (kept) Object.assign(view, { center: kept.center, scale: kept.zoom * view.scale, moved: true });
    kept = null;
  }
  // A new size of the canvas must not fit the view to other bounds.
  else if (before.some((one, k) => one !== view.bounds[k])) view.moved = true;
  fitting = false;
  viewed.value = viewed.peek() + 1;
});
