// A stored run, to be compared with the present one: solution.npz of kempe run, or the NPZ of this page.
import type { NumbersOf } from "./npz";

/** Curves by the names of their quantities. */
export interface Stored {
  file: string;
  t: Float64Array;
  rows: Map<string, Float64Array>;
}

/** The quantities of the columns of q, v and a for each coordinate. */
const RATES: Record<string, [string, string]> = { x: ["vx", "ax"], y: ["vy", "ay"], angle: ["omega", "alpha"] };

/** The curves of a file; null if it is not a run of a mechanism with these coordinates. */
export function storedRun(
  file: string,
  arrays: Record<string, NumbersOf>,
  coordinates: readonly string[],
): Stored | null {
  const t = arrays.t;
  if (t?.shape.length !== 1) return null;
  const n = t.values.length;
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
  return rows.size ? { file, t: t.values, rows } : null;
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
