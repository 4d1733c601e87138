// What a plot shows: curves of one unit, each over its own outputs.

export interface Curve {
  readonly name: string;
  /** The SI unit. */
  readonly unit: string;
  /** Decides the colour, and the dashes of a curve of the run. */
  readonly number: number;
  /** Whether it belongs to a stored run: such a curve is thin and dashed. */
  readonly stored: boolean;
  /** The time of each output, or the values that take its place; they grow. */
  readonly t: ArrayLike<number>;
  /** Values at the outputs. */
  readonly values: ArrayLike<number>;
  /** Whether values between two outputs lie on a curve, not on the straight line between both. */
  readonly smooth: boolean;
  /** The value at t. */
  at(t: number): number;
  /** A value as it is shown: without rounding errors. */
  shown(value: number): number;
}

/** What lies on the horizontal axis, and by what its values are divided there. */
export interface Across {
  readonly name: string;
  readonly shown: string;
  readonly divisor: number;
}

/** The values at the outputs, as they are shown. */
export function shownValues(curve: Curve): number[] {
  return Array.from(curve.values, (value) => curve.shown(value));
}
