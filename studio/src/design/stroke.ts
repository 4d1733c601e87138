// A path that is drawn by hand: its points at equal distances become those of the task.
import { signal } from "@preact/signals";
import { snapStep } from "../draw/measure";
import { distance, type Point, rounded } from "../plane/points";
import { change } from "../store/document";
import { view } from "../store/sheet";
import { announce } from "../store/state";
import { texts } from "../texts";
import { active, withRows } from "./task";

/** Points of a path. */
const COUNT = 36;
/** A shorter line is none, px; a path is closed if its ends are nearer than this share of its length. */
const SHORT = 40;
const GAP = 0.06;

/** The line that is being drawn, m. */
export const stroke = signal<Point[]>([]);

export function begin(at: Point): void {
  stroke.value = [at];
}

export function follow(at: Point): void {
  if (stroke.value.length) stroke.value = [...stroke.value, at];
}

export function drop(): void {
  stroke.value = [];
}

/** The points become the task. */
export async function finish(): Promise<void> {
  const points = even(stroke.value, COUNT);
  drop();
  if (!points) return;
  const step = snapStep(view) / 100;
  active.value = null;
  if (points.length < COUNT) announce("info", texts.design.short);
  else await change(withRows(points.map((at) => at.map((x) => rounded(x, step)))));
}

/** Points at equal distances along a line, those of a closed one without its first point again; none if it is too short. */
function even(line: readonly Point[], count: number): Point[] | null {
  if (line.length < 2) return null;
  const far = [0];
  const add = (at: Point, before: Point) => far.push(far.at(-1)! + distance(before, at));
  line.forEach((at, k) => k && add(at, line[k - 1]!));
  if (far.at(-1)! * view.scale < SHORT) return [];
  const closed = distance(line[0]!, line.at(-1)!) < GAP * far.at(-1)!;
  const all = closed ? [...line, line[0]!] : line;
  if (closed) add(line[0]!, line.at(-1)!);
  const step = far.at(-1)! / (closed ? count : count - 1);
  let k = 0;
  return Array.from({ length: count }, (_, j) => {
    while (k < all.length - 2 && far[k + 1]! < step * j) k += 1;
    const share = Math.min(1, (step * j - far[k]!) / (far[k + 1]! - far[k]! || 1));
    return [0, 1].map((i) => all[k]![i]! + share * (all[k + 1]![i]! - all[k]![i]!)) as Point;
  });
}
