// Numbers for people: round steps, SI prefixes, as many digits as can be distinguished.

const PREFIXES = [[1e9, "G"], [1e6, "M"], [1e3, "k"], [1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** The largest of 1, 2, 5, 10, 20 … that is not above a positive value. */
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-12);
  return ([5, 2, 1].find((step) => step * power <= value * (1 + 1e-12)) ?? 1) * power;
}

/** By what to divide values up to `largest`, and the unit that they have then. */
export function scaled(largest, unit) {
  if (/^(N|N·m|m)$/.test(unit)) {
    const [factor, prefix] = PREFIXES.find(([least]) => largest >= least) ?? [1, ""];
    return { factor, unit: prefix + unit };
  }
  if (largest === 0 || (largest >= 1e-2 && largest < 1e5)) return { factor: 1, unit };
  const power = 3 * Math.floor(Math.log10(largest) / 3);
  return { factor: 10 ** power, unit: `10${superscript(power)} ${unit}` };
}

function superscript(power) {
  const digits = [...String(Math.abs(power))].map((digit) => SUPERSCRIPTS[Number(digit)]);
  return (power < 0 ? "⁻" : "") + digits.join("");
}

/** A value with its unit, such as "25.0 kN". */
export function quantity(value, unit, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  const { factor, unit: told } = scaled(Math.abs(value), unit);
  const text = value === 0 ? "0" : (value / factor).toPrecision(digits);
  return `${minus(text)} ${told}`;
}

/** A round quantity, such as "10 kN". */
export function roundQuantity(value, unit) {
  const { factor, unit: told } = scaled(value * 1.0000001, unit);
  return `${Number((value / factor).toPrecision(3))} ${told}`;
}

/** Round ticks within a range, about `count` of them, and how to write them. */
export function ticks(low, high, count) {
  const span = high - low;
  if (!(span > 0)) return { values: [low], write: (value) => minus(String(Number(value.toPrecision(6)))) };
  let step = roundBelow(span / Math.max(1, count));
  if (span / step > 1.5 * count) step = roundBelow(step * 2.5);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const values = Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return { values, write: (value) => minus((Math.abs(value) < step / 2 ? 0 : value).toFixed(Math.min(decimals, 20))) };
}

/** With a proper minus sign. */
export function minus(text) {
  return text.replace("-", "−");
}

/** How many decimals tell one frame from the next, at least milliseconds. */
export function timeDecimals(times) {
  const spacing = (times[times.length - 1] - times[0]) / Math.max(1, times.length - 1);
  return spacing > 0 ? Math.min(15, Math.max(3, -Math.floor(Math.log10(spacing)))) : 3;
}

/** A name that fits into a drawing; whole characters are kept, not halves of a pair. */
export function shortened(name, most = 24) {
  const characters = [...name];
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : name;
}
