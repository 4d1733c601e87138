// Ticks of axes at round values, and their texts.
import { minus, powerOfTen } from "./numbers";

export interface Ticks {
  values: number[];
  write(value: number): string;
}

/** The largest of …, 1, 2, 5, 10, 20, … that does not exceed a positive value. */
export function roundBelow(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-12);
  return ([5, 2, 1].find((step) => step * power <= value * (1 + 1e-12)) ?? 1) * power;
}

/** Round ticks within a range, about `count` of them. */
export function ticks(low: number, high: number, count: number): Ticks {
  const span = high - low;
  if (!(span > 0)) return { values: [low], write: (value) => minus(String(Number(value.toPrecision(6)))) };
  let step = roundBelow(span / Math.max(1, count));
  if (span / step > 1.5 * count) step = roundBelow(step * 2.5);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return {
    values: multiples(low, high, step),
    write: (value) => minus((Math.abs(value) < step / 2 ? 0 : value).toFixed(Math.min(decimals, 20))),
  };
}

/** Steps of angles in degrees that people know. */
const DEGREES = [2, 5, 10, 15, 30, 45, 90, 180, 360];

/** Ticks of angles in degrees. Their steps are 15°, 45° and 90° in place of 20°, 50° and 100°. */
export function angleTicks(low: number, high: number, count: number): Ticks {
  const step = DEGREES.find((one) => (high - low) / one <= 1.5 * count);
  if (!step || high - low < 2 * count) return ticks(low, high, count);
  return { values: multiples(low, high, step), write: (value) => minus(value.toFixed(0)) };
}

/** Powers of ten within a range of exponents, at most about `count` of them. */
export function decades(low: number, high: number, count: number): Ticks {
  const step = Math.max(1, Math.ceil((high - low) / Math.max(1, count)));
  return { values: multiples(low, high, step), write: powerOfTen };
}

function multiples(low: number, high: number, step: number): number[] {
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
}

/** The number of decimals that distinguish consecutive frames; at least three. */
export function timeDecimals(times: readonly number[]): number {
  const spacing = (times[times.length - 1]! - times[0]!) / Math.max(1, times.length - 1);
  return spacing > 0 ? Math.min(15, Math.max(3, -Math.floor(Math.log10(spacing)))) : 3;
}
