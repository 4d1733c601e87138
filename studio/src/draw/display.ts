// Units of the display: lengths in m or mm, angles in degrees and speeds in rpm, or all in SI units and rad.

const DEGREES = 180 / Math.PI;
const RPM = 30 / Math.PI;

/** Units of length with the number of them in a metre. With m, small values are written in mm, as in the player. */
export const LENGTHS = { m: 1, mm: 1000 } as const;

export interface Units {
  /** Angles in degrees and speeds in rpm. */
  degrees: boolean;
  length: keyof typeof LENGTHS;
}

/** A length, an angle or an energy, or its derivative of an order by the time, a length or an angle. */
const UNIT = /^(m|rad|J)(?:\/(m|rad|s)(?:\^(\d)|(²))?)?$/;

/** The factor that converts values from an SI unit to the unit of the display, and this unit. */
export function displayed(unit: string, { degrees, length }: Units): { factor: number; unit: string } {
  const [, of, by, power, squared] = UNIT.exec(unit) ?? [];
  if (!of) return { factor: 1, unit };
  if (degrees && unit === "rad/s") return { factor: RPM, unit: "rpm" };
  const factor = (base = "") => (base === "m" ? LENGTHS[length] : base === "rad" && degrees ? DEGREES : 1);
  const name = (base: string) => (base === "m" ? length : base === "rad" && degrees ? "°" : base);
  const order = squared ? 2 : Number(power ?? 1);
  const written = by ? `${name(of)}/${name(by)}${unit.slice(of.length + 1 + by.length)}` : name(of);
  return { factor: factor(of) / factor(by) ** order, unit: written };
}
