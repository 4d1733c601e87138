// The curves of a plot. They have one unit, and each has its own outputs.

export interface Curve {
  readonly name: string;
  /** The SI unit. */
  readonly unit: string;
  /** The number that determines colour and dashes. */
  readonly number: number;
  /** Whether it belongs to a stored run; it is then thin and dashed. */
  readonly stored: boolean;
  /** The time of each output, or the value of the quantity that replaces it, in growing order. */
  readonly t: ArrayLike<number>;
  /** Values at the outputs. */
  readonly values: ArrayLike<number>;
  /** Whether values between outputs lie on a smooth curve instead of a straight line. */
  readonly smooth: boolean;
  /** The value at t. */
  at(t: number): number;
  /** The shown value: zero for rounding errors. */
  shown(value: number): number;
}

/** The quantity on the horizontal axis, with its unit there and the divisor of its SI values. */
export interface Across {
  readonly name: string;
  readonly shown: string;
  readonly divisor: number;
  /** What forces over this quantity contain, in words; empty over time. */
  readonly condition: string;
}

/** The shown values at the outputs. */
export function shownValues(curve: Curve): number[] {
  return Array.from(curve.values, (value) => curve.shown(value));
}
