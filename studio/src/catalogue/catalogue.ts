// The catalogue of the core: every type with its fields. No type is named in the code of the page.

export type Shape = string | { words: string[] } | { options: string };

export interface Field {
  name: string;
  shape: Shape;
  unit: string;
  required: boolean;
  default: unknown;
  doc: string;
}

export interface Type {
  name: string;
  doc: string;
  fields: Field[];
  joins_points?: boolean;
}

export const GROUPS = ["bodies", "joints", "drivers", "forces"] as const;
export type Group = (typeof GROUPS)[number];

export interface Catalogue extends Record<Group, Type[]> {
  analyses: Type[];
  units: { name: string; si: number; dimension: string }[];
}

/** The catalogue in the reply of the core, whose elements may be in a table of their own. */
export function readCatalogue(reply: unknown): Catalogue {
  const outer = reply as Record<string, unknown>;
  const all = { ...outer, ...((outer.elements as object) ?? {}) } as Partial<Catalogue>;
  return {
    bodies: all.bodies ?? [],
    joints: all.joints ?? [],
    drivers: all.drivers ?? [],
    forces: all.forces ?? [],
    analyses: all.analyses ?? [],
    units: all.units ?? [],
  };
}

/** The type of an entry of a group. A body without a type is of the first type; ground has its name. */
export function typeOf(catalogue: Catalogue, group: Group, name: string, entry: unknown): Type | undefined {
  const written = (entry as { type?: unknown } | undefined)?.type;
  const types = catalogue[group];
  if (typeof written === "string") return types.find((type) => type.name === written);
  if (group !== "bodies") return undefined;
  return types.find((type) => type.name === name) ?? types[0];
}

/** The default of a field as text, or empty. */
export function defaultText(field: Field): string {
  const { default: value } = field;
  if (value === null || value === undefined) return "";
  if (typeof value === "object" && !Array.isArray(value)) return "";
  return typeof value === "string" ? value : JSON.stringify(value);
}

/** Whether a joint is a pin: two points coincide, and their bodies turn freely. */
export function isPin(type: Type): boolean {
  return type.joins_points === true;
}

/** A name of the file in words: "torsion_spring" is "Torsion spring". */
export function spoken(name: string): string {
  const words = name.replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
