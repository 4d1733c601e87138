// A stored run for a comparison with the present run: solution.npz of kempe run, or the NPZ of this page.
import type { Quantity } from "../core/protocol";
import type { Contents, NumbersOf } from "./npz";

/** Curves by the names of their quantities, over the time or the quantity that replaces it. */
export interface Stored {
  file: string;
  variable: Quantity;
  /** The values of the variable, in growing order. A run to lower values is reversed. */
  t: Float64Array;
  rows: Map<string, Float64Array>;
}

const TIME: Quantity = { name: "t", unit: "s" };
/** The quantities of the columns of q, v and a for each coordinate. */
const RATES: Record<string, [string, string]> = { x: ["vx", "ax"], y: ["vy", "ay"], angle: ["omega", "alpha"] };

/** The curves of a file; null if it is not a run of a mechanism with these coordinates. */
export function storedRun(file: string, { arrays, texts }: Contents, coordinates: readonly string[]): Stored | null {
  const t = arrays.t;
  if (t?.shape.length !== 1) return null;
  const n = t.values.length;
  const variable = variableOf(texts);
  const rows = new Map<string, Float64Array>();
  for (const [name, { shape, values }] of Object.entries(arrays))
    if (name !== "t" && shape.length === 1 && shape[0] === n) rows.set(name, values);
  const tables = [arrays.q, arrays.v, arrays.a];
  if (arrays.q) {
    if (!tables.every((one) => !one || (one.shape[0] === n && one.shape[1] === coordinates.length))) return null;
    coordinates.forEach((name, column) => {
      for (const [quantity, table] of named(name, tables)) rows.set(quantity, columnOf(table, column));
    });
  }
  rows.delete(variable.name);
  if (!rows.size) return null;
  const falls = n > 1 && t.values[0]! > t.values[n - 1]!;
  const forwards = (row: Float64Array) => (falls ? row.slice().reverse() : row);
  const turned = [...rows].map(([name, row]) => [name, forwards(row)] as const);
  return { file, variable, t: forwards(t.values), rows: new Map(turned) };
}

/** The quantity in `t`. Its name is in `about` of files of kempe, and in `variable` of files of this page. */
function variableOf({ about, variable }: Contents["texts"]): Quantity {
  const [name, unit] = variable ?? aboutVariable(about?.[0] ?? "");
  return name && unit ? { name, unit } : TIME;
}

function aboutVariable(text: string): string[] {
  try {
    const { variable } = JSON.parse(text) as { variable?: unknown };
    return Array.isArray(variable) && variable.every((one) => typeof one === "string") ? variable : [];
  } catch {
    return [];
  }
}

/** The names of a coordinate, its rate and its acceleration, with the tables that have them. */
function named(coordinate: string, [q, v, a]: (NumbersOf | undefined)[]): [string, NumbersOf][] {
  const at = coordinate.lastIndexOf(".");
  const owner = coordinate.slice(0, at + 1);
  const [rate, acceleration] = RATES[coordinate.slice(at + 1)] ?? [];
  const all: [string, NumbersOf | undefined][] = [
    [coordinate, q],
    [rate ? owner + rate : "", v],
    [acceleration ? owner + acceleration : "", a],
  ];
  return all.filter((one): one is [string, NumbersOf] => one[0] !== "" && one[1] !== undefined);
}

function columnOf({ shape, values }: NumbersOf, column: number): Float64Array {
  const [n, width] = shape as [number, number];
  return Float64Array.from({ length: n }, (_, k) => values[k * width + column]!);
}

/**
 * The values of a stored quantity over the axis of the plots; null if they have no place there.
 *
 * A run over another variable has a place if it contains the variable of the axis as a quantity that grows. Its rates,
 * forces and powers belong to another motion, so that only positions are compared then.
 */
export function onAxis(
  stored: Stored,
  axis: Quantity,
  { name, unit }: Quantity,
): { t: Float64Array; row: Float64Array } | null {
  const row = stored.rows.get(name);
  if (!row) return null;
  if (stored.variable.name === axis.name) return { t: stored.t, row };
  const t = stored.rows.get(axis.name);
  const grows = t?.every((value, k) => k === 0 || value >= t[k - 1]!);
  return t && grows && (unit === "m" || unit === "rad") ? { t, row } : null;
}
