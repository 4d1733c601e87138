// Tools of the palette. The clicks that make an entry follow from the fields of its type.
import { type Catalogue, type Field, GROUPS, type Group, spoken, type Type } from "./catalogue";

export type Reference = "point" | "body" | "coordinate" | "joint" | "curve";
const REFERENCES: readonly string[] = ["point", "body", "coordinate", "joint", "curve"];

/** The clicks that place a body: two points, any number of points, one point, or points of the fixed body. */
export type Placing = "two" | "many" | "one" | "fixed";

export interface Tool {
  group: Group;
  type: Type;
  label: string;
  /** The fields that clicks fill, in order: references, and the coordinates of a table or formula. */
  references: Field[];
  placing: Placing | null;
}

export function toolsOf(catalogue: Catalogue): Tool[] {
  return GROUPS.flatMap((group) => catalogue[group].map((type) => toolOf(group, type)));
}

function toolOf(group: Group, type: Type): Tool {
  const placing = group === "bodies" ? placingOf(type) : null;
  const references = type.fields.filter(({ required }) => required).flatMap(chosenBy);
  return { group, type, label: spoken(type.name), references, placing };
}

/** The number of coordinates in the initial value of a shape. */
const COORDINATES: Record<string, number> = { terms: 2, laws: 1 };

/** The references that clicks must give for a field. */
function chosenBy(field: Field): Field[] {
  if (isReference(field)) return [field];
  const count = COORDINATES[String(field.shape)] ?? 0;
  return Array.from({ length: count }, (_, k) => ({ ...field, name: `${field.name} ${k + 1}`, shape: "coordinate" }));
}

export function isReference({ shape }: Field): boolean {
  return typeof shape === "string" && REFERENCES.includes(shape);
}

function placingOf({ fields }: Type): Placing {
  const has = (name: string) => fields.some((field) => field.name === name);
  if (has("ends")) return "two";
  if (has("through")) return "many";
  return has("mass") ? "one" : "fixed";
}
