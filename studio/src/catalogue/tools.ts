// Tools of the palette: what has to be clicked to make an entry follows from the fields of its type.
import { type Catalogue, type Field, GROUPS, type Group, spoken, type Type } from "./catalogue";

export type Reference = "point" | "body" | "coordinate" | "joint" | "curve";
const REFERENCES: readonly string[] = ["point", "body", "coordinate", "joint", "curve"];

/** How a body is placed: through two points, through any number, at one point, or as points of the fixed body. */
export type Placing = "two" | "many" | "one" | "fixed";

export interface Tool {
  group: Group;
  type: Type;
  label: string;
  /** The references that clicks choose, in their order. */
  references: Field[];
  placing: Placing | null;
}

export function toolsOf(catalogue: Catalogue): Tool[] {
  return GROUPS.flatMap((group) => catalogue[group].map((type) => toolOf(group, type)));
}

function toolOf(group: Group, type: Type): Tool {
  const placing = group === "bodies" ? placingOf(type) : null;
  const references = type.fields.filter((field) => field.required && isReference(field));
  return { group, type, label: spoken(type.name), references, placing };
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
