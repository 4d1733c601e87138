// Fingers and wheel as movements of a view.
import { distance, type Point } from "./points";

/** Middle of the fingers and the distance between the first two, px. */
export interface Spread {
  middle: Point;
  width: number;
}

/** The position of a pointer, px from the corner of an element. */
export function placeOn(element: Element, event: MouseEvent): Point {
  const { left, top } = element.getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

export function spreadOf(fingers: Map<number, Point>): Spread {
  const places = [...fingers.values()];
  const middle = [0, 1].map((k) => places.reduce((sum, at) => sum + at[k]!, 0) / places.length) as Point;
  const [a, b] = places;
  return { middle, width: a && b ? distance(a, b) : 0 };
}

/** The magnification of a turn of the wheel. */
export function turned({ deltaY, deltaMode }: WheelEvent): number {
  const pixels = deltaY * (deltaMode === 1 ? 16 : 1);
  return Math.exp(-Math.max(-200, Math.min(200, pixels)) / 400);
}
