// Numbers for people: round steps, units with prefixes, as many digits as can be distinguished.

const PREFIXES = { 9: "G", 6: "M", 3: "k", 0: "", "-3": "m", "-6": "µ", "-9": "n" };
/** The powers that a prefix expresses; the rules are those of kempe/draw/units.py. */
const WITH_PREFIX = {
  m: [0, -3, -6, -9],
  rad: [0, -3],
  "m/s": [0, -3, -6],
  "m/s²": [0, -3, -6],
  N: [9, 6, 3, 0, -3, -6],
  "N·m": [9, 6, 3, 0, -3, -6],
  J: [9, 6, 3, 0, -3, -6],
};
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** The largest of 1, 2, 5, 10, 20 … that is not above a positive value. */
export function roundBelow(value) {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-12);
  return ([5, 2, 1].find((step) => step * power <= value * (1 + 1e-12)) ?? 1) * power;
}

/** By what to divide values up to `peak`, and the unit that they have then. */
export function scaled(peak, unit) {
  const power = powerOf(peak);
  if (!power || (unit.startsWith("°") && Math.abs(power) <= 3)) return { factor: 1, unit };
  const prefix = WITH_PREFIX[unit]?.includes(power);
  return { factor: 10 ** power, unit: prefix ? PREFIXES[power] + unit : `${powerOfTen(power)} ${unit}` };
}

function powerOf(peak) {
  if (!(peak > 0) || !Number.isFinite(peak) || (peak >= 0.2 && peak < 2)) return 0;
  return 3 * Math.floor(Math.log10(peak >= 2 ? peak / 2 : peak) / 3);
}

/** Such as 10⁻³. */
export function powerOfTen(power) {
  const digits = [...String(Math.abs(power))].map((digit) => SUPERSCRIPTS[Number(digit)]);
  return `10${power < 0 ? "⁻" : ""}${digits.join("")}`;
}

/** Label of an axis, such as "x / mm" and "v / (m/s)". */
export function axisLabel(symbol, unit) {
  return `${symbol} / ${/[/ ]/.test(unit) ? `(${unit})` : unit}`;
}

/** A value with five digits for the largest of its channel: all values of a channel have the same decimals. */
export function fixed(value, peak) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0 || !(peak > 0)) return "0";
  const decimals = 4 - Math.floor(Math.log10(peak));
  return minus(value.toFixed(Math.min(12, Math.max(0, decimals))));
}

/** A value with four significant digits, such as 12.34 and 1.234·10⁻⁷. */
export function significant(value) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e5)) return minus(value === 0 ? "0" : value.toPrecision(4));
  const [mantissa, power] = value.toExponential(3).split("e");
  return `${minus(mantissa)}·${powerOfTen(Number(power))}`;
}

/** A number and its unit; the sign of degrees follows without a space. */
export function withUnit(text, unit) {
  return unit === "°" ? `${text}°` : `${text} ${unit}`;
}

/** A value with its unit, such as "25.0 kN". */
export function quantity(value, unit, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  const { factor, unit: written } = scaled(Math.abs(value), unit);
  const number = value / factor;
  const text = Math.abs(number) < 10 ** digits ? number.toPrecision(digits) : number.toFixed(0);
  return `${minus(value === 0 ? "0" : text)} ${written}`;
}

/** A round quantity, such as "10 kN". */
export function roundQuantity(value, unit) {
  const { factor, unit: written } = scaled(value * 1.0000001, unit);
  return `${Number((value / factor).toPrecision(3))} ${written}`;
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

/** Powers of ten within a range of exponents, at most about `count` of them. */
export function decades(low, high, count) {
  const step = Math.max(1, Math.ceil((high - low) / Math.max(1, count)));
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return { values: Array.from({ length: last - first + 1 }, (_, k) => (first + k) * step), write: powerOfTen };
}

/** With a proper minus sign. */
export function minus(text) {
  return text.replace("-", "−");
}

/** How many decimals distinguish one frame from the next, at least milliseconds. */
export function timeDecimals(times) {
  const spacing = (times[times.length - 1] - times[0]) / Math.max(1, times.length - 1);
  return spacing > 0 ? Math.min(15, Math.max(3, -Math.floor(Math.log10(spacing)))) : 3;
}

/** A name that fits into a drawing; whole characters are kept, not halves of a pair. */
export function shortened(name, most = 24) {
  const characters = [...name];
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : name;
}
