// Values of the time, or of the quantity that replaces it, as texts in display units.
import { displayed } from "../draw/display";
import { minus } from "../draw/numbers";
import { units } from "../store/state";

/** A value with six digits and its unit, such as "1.2 s" and "360°". */
export function written(value: number, base: string): string {
  const { factor, unit } = displayed(base, units.value);
  return joined(String(Number((value * factor).toPrecision(6))), unit);
}

/** The same with a fixed number of decimals, so that the text keeps its width during a motion. */
export function clock(value: number, base: string): string {
  const { factor, unit } = displayed(base, units.value);
  return joined((value * factor).toFixed(unit === "°" ? 1 : 3), unit);
}

function joined(number: string, unit: string): string {
  return `${minus(number)}${unit === "°" ? "" : " "}${unit}`;
}
