// Curves as CSV.
import type { Quantity } from "../core/protocol";
import { conditionOf } from "../draw/condition";

/**
 * One line for each value of the first column, in SI units and rad, with all digits.
 *
 * A header has the name and the unit; in a motion over a quantity, that of a force also has the condition of the first
 * column.
 */
export function csv(
  t: Float64Array,
  names: string[],
  units: string[],
  rows: Float64Array[],
  first: Quantity & { condition: string } = { name: "t", unit: "s", condition: "" },
): string {
  const beside = (unit: string) => [unit, conditionOf(unit, first.condition)].filter(Boolean).join(", ");
  const columns = names.map((name, k) => `${name} [${beside(units[k]!)}]`);
  const head = [`${first.name} [${first.unit}]`, ...columns].map(cell);
  const number = (value: number) => (Number.isFinite(value) ? String(value) : "nan");
  const lines = Array.from(t, (one, k) => [one, ...rows.map((row) => row[k]!)].map(number).join(","));
  return [head.join(","), ...lines, ""].join("\n");
}

/** A cell of text that no spreadsheet takes for a formula (RFC 4180, with an apostrophe before it). */
function cell(text: string): string {
  const safe = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
