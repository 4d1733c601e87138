// The condition of a motion over a quantity: which inertia and damping its forces contain.

/** Units of forces and torques, and of powers per rad or m. */
const FORCES = /^(N|N[*·]m|J\/(m|rad))$/;

/** The condition, if it concerns values of this SI unit; otherwise an empty text. */
export function conditionOf(unit: string, condition: string): string {
  return FORCES.test(unit) ? condition : "";
}
