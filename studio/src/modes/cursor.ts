// Drawing by keys: arrow keys move a place on the sheet, and another key clicks there.
import { snapStep } from "../draw/measure";
import type { Point } from "../plane/points";
import { view } from "../store/sheet";
import type { Spot } from "./handler";
import { handler } from "./modes";

let at: Point | null = null;

function spot(): Spot {
  return { px: view.toScreen(at!), at: at!, touch: false, free: false };
}

/** Move the place by steps of the grid; it begins at `start`. */
export function moveCursor(start: Point, dx: number, dy: number): void {
  const [x, y] = at ?? start;
  const step = snapStep(view);
  at = [x + dx * step, y + dy * step];
  handler().hover?.(spot());
}

/** Click at the place. The next move of the keys begins at `start` again. */
export function clickCursor(start: Point): void {
  at ??= start;
  handler().click?.(spot());
  at = null;
}
