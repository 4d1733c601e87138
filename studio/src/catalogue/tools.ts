// Tools of the palette. The clicks that make an entry follow from the fields of its type.
import { texts } from "../texts";
import { type Catalogue, type Field, GROUPS, type Group, spoken, type Type } from "./catalogue";

export type Reference = "point" | "body" | "coordinate" | "joint" | "curve";
const REFERENCES: readonly string[] = ["point", "body", "coordinate", "joint", "curve"];

/** Machines of several elements, each with a tool of its own. */
export const MACHINES = ["slider", "cylinder"] as const;

/** The clicks that place a body: two points, any number of points, one point, points of the fixed body, or a machine. */
export type Placing = "two" | "many" | "one" | "fixed" | (typeof MACHINES)[number];

export interface Tool {
  group: Group;
  type: Type;
  label: string;
  /** The start of the names of new entries. */
  stem: string;
  /** The fields that clicks fill, in order: references, and the coordinates of a table or formula. */
  references: Field[];
  placing: Placing | null;
}

export function toolsOf(catalogue: Catalogue): Tool[] {
  const bodies = catalogue.bodies.length ? MACHINES : [];
  return [
    ...GROUPS.flatMap((group) => catalogue[group].map((type) => toolOf(group, type))),
    ...bodies.map((name): Tool => {
      const type = { name, doc: texts.machines[name], fields: [] };
      return { ...toolOf("bodies", type), placing: name };
    }),
  ];
}

function toolOf(group: Group, type: Type): Tool {
  const placing = group === "bodies" ? placingOf(type) : null;
  // a contact of two curves is written in the text; the tool makes one of a point and a curve
  const either = type.fields.some(({ shape }) => shape === "two_texts");
  const clicked = (field: Field) => field.required || (either && isReference(field));
  const references = type.fields.filter(clicked).flatMap(chosenBy);
  const stem = texts.stems[type.name] ?? type.name.replaceAll("_", "");
  return { group, type, label: texts.labels[type.name] ?? spoken(type.name), stem, references, placing };
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
