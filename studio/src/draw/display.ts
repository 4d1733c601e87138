// Units of the display: angles in degrees and speeds in rpm, or all in SI units and rad.

const DEGREES = 180 / Math.PI;
const RPM = 30 / Math.PI;

/** By what to multiply values of an SI unit, and the unit that they have then. */
export function displayed(unit: string, degrees: boolean): { factor: number; unit: string } {
  if (!degrees || !/^rad(?!\w)/.test(unit)) return { factor: 1, unit };
  if (unit === "rad/s") return { factor: RPM, unit: "rpm" };
  return { factor: DEGREES, unit: unit.replace("rad", "°") };
}
