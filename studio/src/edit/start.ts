// The prescribed values of the start, by the names of their quantities. Tables may be nested.
import { isTable } from "../catalogue/tree";
import type { Path, Tree, Value } from "../core/protocol";

export interface Prescribed {
  /** The quantity, such as "crank.angle". */
  name: string;
  value: Value;
  path: Path;
}

export function prescribed(tree: Tree | null, part: "set" | "guess" = "set"): Prescribed[] {
  const start = tree?.start;
  const table = isTable(start) ? start[part] : undefined;
  return isTable(table) ? within(table, ["start", part], []) : [];
}

function within(table: Tree, path: Path, names: string[]): Prescribed[] {
  return Object.entries(table).flatMap(([key, value]) => {
    const [own, all] = [
      [...path, key],
      [...names, key],
    ];
    return isTable(value) ? within(value, own, all) : [{ name: all.join("."), value, path: own }];
  });
}

/** The rate of a position quantity, such as "crank.omega" of "crank.angle"; undefined if it has no name. */
export function rateOf(name: string): string | undefined {
  const rates: Record<string, string> = { angle: "omega", x: "vx", y: "vy", displacement: "rate", length: "rate" };
  const dot = name.lastIndexOf(".") + 1;
  const rate = rates[name.slice(dot)];
  return rate && name.slice(0, dot) + rate;
}

/** Whether a name is that of a velocity. */
export function isRate(name: string): boolean {
  return /\.(omega|vx|vy|rate)$/.test(name);
}
