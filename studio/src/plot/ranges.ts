// The range of the vertical axis of a plot.
import type { Point } from "../plane/points";

/** The least and the largest value, with some room. */
export function widened(values: number[][], divisor: number): Point {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values.flat()) [low, high] = [Math.min(low, value / divisor), Math.max(high, value / divisor)];
  if (!(high >= low)) return [0, 1];
  const room = 0.06 * (high - low) || 0.5 * Math.abs(high) || 1;
  return [low === 0 ? 0 : low - room, high + room];
}

/** The powers of ten around the magnitudes, zeros left out. */
export function exponents(values: number[][]): Point {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const value of values.flat()) {
    if (value === 0) continue;
    const exponent = Math.log10(Math.abs(value));
    [low, high] = [Math.min(low, exponent), Math.max(high, exponent)];
  }
  const [first, last] = [Math.floor(Math.max(low, high - 16)), Math.ceil(high)];
  return [first, Math.max(last, first + 1)];
}
