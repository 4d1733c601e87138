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

/** By what to multiply values of an SI unit, and the unit that they have then. */
export function displayed(unit: string, { degrees, length }: Units): { factor: number; unit: string } {
  if (/^m(?=$|\/s)/.test(unit)) return { factor: LENGTHS[length], unit: unit.replace("m", length) };
  if (!degrees || !/^rad(?!\w)/.test(unit)) return { factor: 1, unit };
  if (unit === "rad/s") return { factor: RPM, unit: "rpm" };
  return { factor: DEGREES, unit: unit.replace("rad", "°") };
}
