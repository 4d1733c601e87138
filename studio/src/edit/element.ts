// The change of the text that adds an element with initial values.
import type { Field } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { freeName } from "../catalogue/tree";
import type { Change, Tree, Value } from "../core/protocol";
import type { Added } from "./adding";
import { evenLaw, type Motion } from "./driving";

/** The source of initial values: a length of the drawing, and the clicked coordinates. */
interface Scale {
  length: number;
  /** Whether the display has degrees and rpm. */
  degrees: boolean;
  now: readonly Motion[];
}

/** An element whose references have been chosen. */
export function addElement(
  { group, type }: Tool,
  chosen: Record<string, Value>,
  scale: Scale,
  tree: Tree | null,
): Added {
  const name = freeName(tree, type.name.replaceAll("_", ""));
  const value: Tree = { type: type.name };
  const changes: Change[] = [];
  const isSum = type.fields.some(({ shape }) => shape === "terms");
  const [first] = scale.now;
  for (const field of type.fields) {
    if (field.name in chosen) value[field.name] = chosen[field.name]!;
    else if (field.required && isOfCoordinate(field) && first) {
      const even = evenLaw(first, scale, tree);
      value[field.name] = even.law;
      changes.push(...even.changes);
    } else if (field.required) value[field.name] = startingValue(field, scale);
    else if (isSum && isOfCoordinate(field)) value[field.name] = sum(scale.now);
  }
  return { changes: [...changes, { path: [group, name], value }], name };
}

/** Whether a field is the law of a position quantity. */
function isOfCoordinate({ shape, unit }: Field): boolean {
  return shape === "law" && unit.includes("|") && unit.includes("rad");
}

/** Factors of coordinates: 1 for the first, -1 for the others. */
function factor(k: number): number {
  return k ? -1 : 1;
}

function sum(now: readonly Motion[]): number {
  return Number(now.reduce((all, { value }, k) => all + factor(k) * value, 0).toPrecision(12));
}

/** An initial value for a required field. */
function startingValue({ shape, unit }: Field, { length, now }: Scale): Value {
  const one = unit === "m" ? Number(length.toPrecision(4)) : 1;
  if (shape === "pair" || shape === "law_pair") return [one, one];
  if (shape === "triple") return [1, 1, 1];
  if (shape === "terms") return Object.fromEntries(now.map(({ name }, k) => [name, factor(k)]));
  if (shape === "laws") return now.map(({ name, value }) => `${name} - (${Number(value.toPrecision(12))})`);
  if (shape === "units") return now.map((of) => of.unit);
  if (typeof shape === "object" && "words" in shape) return shape.words[0]!;
  return one;
}
