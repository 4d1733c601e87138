// Numbers as texts: units with prefixes, and significant digits only.

const PREFIXES: Record<number, string> = { 9: "G", 6: "M", 3: "k", 0: "", [-3]: "m", [-6]: "µ", [-9]: "n" };
/** The powers that a prefix expresses; the rules are those of kempe/draw/units.py. */
const WITH_PREFIX: Record<string, number[]> = {
  m: [0, -3, -6, -9],
  rad: [0, -3],
  "m/s": [0, -3, -6],
  "m/s²": [0, -3, -6],
  N: [9, 6, 3, 0, -3, -6],
  N·m: [9, 6, 3, 0, -3, -6],
  J: [9, 6, 3, 0, -3, -6],
  W: [9, 6, 3, 0, -3, -6],
  Pa: [9, 6, 3, 0],
};
const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** A unit of the core as people write it. */
export function readable(unit: string): string {
  return unit.replaceAll("*", "·").replaceAll("^2", "²").replaceAll("^3", "³");
}

/** The divisor for values up to `peak`, and the unit after the division. */
export function scaled(peak: number, unit: string): { factor: number; unit: string } {
  const power = powerOf(peak);
  const isPlain = /^(°|rpm|mm($|\/))/.test(unit);
  if (!power || (isPlain && Math.abs(power) <= 3)) return { factor: 1, unit };
  const prefix = WITH_PREFIX[unit]?.includes(power);
  return { factor: 10 ** power, unit: prefix ? PREFIXES[power] + unit : `${powerOfTen(power)} ${unit}` };
}

function powerOf(peak: number): number {
  if (!(peak > 0) || !Number.isFinite(peak) || (peak >= 0.2 && peak < 2)) return 0;
  return 3 * Math.floor(Math.log10(peak >= 2 ? peak / 2 : peak) / 3);
}

/** A power of ten, such as 10⁻³. */
export function powerOfTen(power: number): string {
  const digits = [...String(Math.abs(power))].map((digit) => SUPERSCRIPTS[Number(digit)]);
  return `10${power < 0 ? "⁻" : ""}${digits.join("")}`;
}

/** A value with its unit, such as "25.0 kN". */
export function quantity(value: number, unit: string, digits = 3): string {
  if (!Number.isFinite(value)) return "–";
  const { factor, unit: written } = scaled(Math.abs(value), readable(unit));
  const number = value / factor;
  const text = Math.abs(number) < 10 ** digits ? number.toPrecision(digits) : number.toFixed(0);
  return minus(value === 0 ? "0" : text) + beside(written);
}

/** A number and its unit; the sign of degrees follows without a space. */
export function besideUnit(text: string, unit: string): string {
  return unit === "°" ? `${text}°` : `${text} ${unit}`.trim();
}

/** A value with its unit and four digits, such as "24.93 kN" and "12.5°". */
export function withUnit(value: number, unit: string): string {
  const written = readable(unit);
  if (WITH_PREFIX[written] && written !== "rad") return quantity(value, unit, 4);
  return besideUnit(significant(value), written);
}

/** A round quantity, such as "10 kN". */
export function roundQuantity(value: number, unit: string): string {
  const { factor, unit: written } = scaled(value * 1.0000001, readable(unit));
  return Number((value / factor).toPrecision(3)) + beside(written);
}

/** A unit behind a number; a power of ten is a factor. */
function beside(unit: string): string {
  return `${unit.startsWith("10") ? "·" : " "}${unit}`;
}

/** A value with `digits` significant digits, such as 12.34 and 1.234·10⁻⁷. */
export function significant(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (value === 0) return "0";
  if (size >= 10 ** digits && size < 1e6) return minus(value.toFixed(0));
  if (size >= 1e-3 && size < 1e6) return minus(value.toPrecision(digits));
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  return `${minus(mantissa ?? "")}·${powerOfTen(Number(power))}`;
}

/** A value of a channel whose largest value is `peak`. All values of the channel have the same number of decimals. */
export function fixed(value: number, peak: number): string {
  if (!Number.isFinite(value)) return "–";
  if (value === 0 || !(peak > 0)) return "0";
  const decimals = 4 - Math.floor(Math.log10(peak));
  return minus(value.toFixed(Math.min(12, Math.max(0, decimals))));
}

/** Label of an axis, such as "x / mm" and "v / (m/s)". */
export function axisLabel(symbol: string, unit: string): string {
  return `${symbol} / ${/[/ ]/.test(unit) ? `(${unit})` : unit}`;
}

/** The text with a minus sign in place of the hyphen. */
export function minus(text: string): string {
  return text.replace("-", "−");
}

/** A name cut to at most `most` characters. A surrogate pair is one character. */
export function shortened(name: string, most = 24): string {
  const characters = [...name];
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : name;
}
