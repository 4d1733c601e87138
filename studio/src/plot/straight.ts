// A curve of given values, straight between its outputs.
import { placeIn } from "../plane/instants";
import type { Curve } from "./curve";

/** Numbers below this are rounding errors, in SI units. */
const NOISE = 1e-12;

type Given = Pick<Curve, "name" | "unit" | "number" | "stored" | "t" | "values">;

export function straight(given: Given): Curve {
  const { t, values } = given;
  const shown = (value: number) => (Math.abs(value) < NOISE ? 0 : value);
  const at = (time: number) => {
    const { low, high, share } = placeIn(t, time);
    const [a, b] = [values[low]!, values[high]!];
    if (share === 0 || share === 1) return shown(share ? b : a); // an output beside a gap has a value
    return shown(a + share * (b - a));
  };
  return { ...given, smooth: false, at, shown };
}

/** The value of the largest magnitude. */
export function peakOf({ values }: Pick<Curve, "values">): number {
  let peak = 0;
  for (let k = 0; k < values.length; k += 1) if (Math.abs(values[k]!) > Math.abs(peak)) peak = values[k]!;
  return peak;
}

/** The name of the vertical axis: that of a single curve, or the common last part of all names. */
export function symbolOf(names: readonly string[]): string {
  const [first, ...others] = names.map((name) => (/^[\w.]+$/.test(name) ? name.split(".").at(-1)! : name));
  if (names.length === 1) return names[0]!;
  return first && others.every((one) => one === first) ? first : "";
}
