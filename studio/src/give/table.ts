// Curves as CSV.
import type { Quantity } from "../core/protocol";

/** One line for each time or value in its place, in SI units and rad, with all digits. */
export function csv(
  t: Float64Array,
  names: string[],
  units: string[],
  rows: Float64Array[],
  first: Quantity = { name: "t", unit: "s" },
): string {
  const head = [`${first.name} [${first.unit}]`, ...names.map((name, k) => `${name} [${units[k]}]`)].map(cell);
  const number = (value: number) => (Number.isFinite(value) ? String(value) : "nan");
  const lines = Array.from(t, (one, k) => [one, ...rows.map((row) => row[k]!)].map(number).join(","));
  return [head.join(","), ...lines, ""].join("\n");
}

/** A cell of text that no spreadsheet takes for a formula (RFC 4180, with an apostrophe before it). */
function cell(text: string): string {
  const safe = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}
