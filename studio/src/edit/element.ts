// The change of the text that adds an element, with values to begin with.
import type { Field } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { freeName } from "../catalogue/tree";
import type { Tree, Value } from "../core/protocol";
import type { Added } from "./adding";

/** A coordinate that was clicked, with its present value. */
export interface Coordinate {
  name: string;
  unit: string;
  value: number;
}

/** What starting values follow from: a length of the drawing, and the coordinates that were clicked. */
interface Scale {
  length: number;
  now: readonly Coordinate[];
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
  const isSum = type.fields.some(({ shape }) => shape === "terms");
  for (const field of type.fields) {
    if (field.name in chosen) value[field.name] = chosen[field.name]!;
    else if (field.required) value[field.name] = startingValue(field, scale);
    else if (isSum && isOfCoordinate(field)) value[field.name] = sum(scale.now);
  }
  return { changes: [{ path: [group, name], value }], name };
}

function isOfCoordinate({ shape, unit }: Field): boolean {
  return shape === "law" && unit.includes("|") && unit.includes("rad");
}

/** Factors of coordinates: the first less the others. */
function factor(k: number): number {
  return k ? -1 : 1;
}

function sum(now: readonly Coordinate[]): number {
  return Number(now.reduce((all, { value }, k) => all + factor(k) * value, 0).toPrecision(12));
}

/** A value to begin with for a required field. A law of a coordinate begins where it is and goes on evenly. */
function startingValue(field: Field, { length, now }: Scale): Value {
  const { shape, unit } = field;
  const one = unit === "m" ? Number(length.toPrecision(4)) : 1;
  const first = now[0];
  if (isOfCoordinate(field) && first) return `${Number(first.value.toPrecision(6))} + t`;
  if (shape === "pair" || shape === "law_pair") return [one, one];
  if (shape === "triple") return [1, 1, 1];
  if (shape === "terms") return Object.fromEntries(now.map(({ name }, k) => [name, factor(k)]));
  if (shape === "laws") return now.map(({ name, value }) => `${name} - (${Number(value.toPrecision(12))})`);
  if (shape === "units") return now.map((of) => of.unit);
  if (typeof shape === "object" && "words" in shape) return shape.words[0]!;
  return one;
}
