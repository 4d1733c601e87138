// The coordinates of bodies that are worth a plot, because a motion changes them visibly.

/** A change below this share of the largest one, or of the range of the plot, is not visible. */
const VISIBLE = 0.01;
/** The curves of a plot. */
const MOST = 3;

/**
 * Some angles that change visibly, in the order of the bodies; without one, the position that changes most. They are numbers of columns.
 * A row has the time, then x, y and angle of each body. `size` is that of the mechanism. Columns that are not `offered`
 * are left out; of equal curves, the first is taken.
 */
export function moving(
  rows: Float64Array,
  width: number,
  size: number,
  offered: (column: number) => boolean = () => true,
): number[] {
  const columns = Array.from({ length: width - 1 }, (_, k) =>
    Float64Array.from({ length: rows.length / width }, (_, n) => rows[n * width + 1 + k]! / (k % 3 === 2 ? 1 : size)),
  );
  const ranges = columns.map(rangeOf);
  const change = (k: number) => ranges[k]![1] - ranges[k]![0];
  const least = VISIBLE * Math.max(...ranges.map((_, k) => change(k)));
  const visible = columns.map((_, k) => k).filter((k) => change(k) > least && offered(k));
  const differs = (k: number, other: number) => columns[k]!.some((x, n) => Math.abs(x - columns[other]![n]!) > least);
  const angles: number[] = [];
  for (const k of visible)
    if (k % 3 === 2 && angles.length < MOST && angles.every((one) => differs(k, one))) angles.push(k);
  const largest = Math.max(...angles.map(change));
  const all = Math.max(...angles.map((k) => ranges[k]![1])) - Math.min(...angles.map((k) => ranges[k]![0]));
  if (angles.length && largest > VISIBLE * all) return angles;
  const most = visible.filter((k) => k % 3 !== 2).sort((a, b) => change(b) - change(a))[0];
  return most === undefined ? angles : [most];
}

function rangeOf(column: Float64Array): [number, number] {
  let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
  for (const x of column) [low, high] = [Math.min(low, x), Math.max(high, x)];
  return Number.isFinite(high - low) ? [low, high] : [0, 0];
}
