// Exchanging the two sides of an element: the pin becomes the slot.
import type { Type } from "../catalogue/catalogue";
import { isTable } from "../catalogue/tree";
import type { Body, Change, Path, Tree, Value } from "../core/protocol";
import type { Placement } from "../plane/points";

/** Whether the two sides of a type can be exchanged. */
export function hasSides({ fields }: Type): boolean {
  const shape = (name: string) => fields.find((field) => field.name === name && field.required)?.shape;
  return shape("i") !== undefined && shape("i") === shape("j");
}

/** Whether an exchange builds another machine: a line belongs to one of the two sides. */
export function hasLine({ fields }: Type): boolean {
  return fields.some(({ name }) => name === "axis");
}

/** The changes that exchange the sides. A line keeps its direction in the plane. */
export function swapped(
  type: Type,
  path: Path,
  entry: Tree,
  bodies: readonly Body[],
  poses: readonly Placement[],
): Change[] {
  const angleOf = (reference: Value | undefined) =>
    poses[bodies.findIndex(({ name }) => name === String(reference).split(".")[0])]?.[2] ?? 0;
  const by = Number((angleOf(entry.i) - angleOf(entry.j)).toPrecision(10));
  const changes: Change[] = [
    { path: [...path, "i"], value: entry.j! },
    { path: [...path, "j"], value: entry.i! },
  ];
  for (const { name, shape } of type.fields) {
    const value = entry[name];
    if (shape === "pair" && Array.isArray(value)) changes.push({ path: [...path, name], value: [...value].reverse() });
    if (name === "axis" && by && !isTable(value)) {
      const turned = typeof value === "string" ? `${value} + (${by})` : Number(value ?? 0) + by;
      changes.push({ path: [...path, name], value: turned });
    }
  }
  return changes;
}
