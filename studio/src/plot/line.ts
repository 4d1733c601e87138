// The line of a curve on the screen. It has points between distant outputs, and leaves out outputs that lie close.
import { broken, type Line } from "../draw/line";
import { placeIn } from "../plane/instants";
import type { Point } from "../plane/points";
import type { Curve } from "./curve";

/** The longest piece between two outputs of a smooth curve, px. */
const PIECE = 4;
const MOST_PIECES = 16;
/** If a pixel has more outputs than this, only the first, the least, the largest and the last are drawn. */
const MOST_ON_A_PIXEL = 4;

/** The place of a value, px; null if it has none. */
export type Place = (t: number, value: number) => Point | null;

/** The line of a curve between two times on an axis of a width, with gaps at missing values. */
export function lineOf(curve: Curve, [from, to]: Point, width: number, place: Place): Line {
  const { t } = curve;
  const [first, last] = [placeIn(t, from).low, placeIn(t, to).high];
  const dense = last - first > MOST_ON_A_PIXEL * width;
  return broken(dense ? thinned(curve, first, last, place) : filled(curve, first, last, width, place));
}

/** The outputs, and points between them on a smooth curve. */
function filled(curve: Curve, first: number, last: number, width: number, place: Place): (Point | null)[] {
  const { t, values } = curve;
  const apart = width / Math.max(1, last - first);
  const pieces = curve.smooth ? Math.min(MOST_PIECES, Math.ceil(apart / PIECE)) : 1;
  const points: (Point | null)[] = [];
  for (let k = first; k <= last; k += 1) {
    points.push(place(t[k]!, curve.shown(values[k]!)));
    for (let piece = 1; piece < pieces && k < last; piece += 1) {
      const at = t[k]! + (piece / pieces) * (t[k + 1]! - t[k]!);
      points.push(place(at, curve.at(at)));
    }
  }
  return points;
}

/** The first, the highest, the lowest and the last output of each column of pixels, in their order. */
function thinned(curve: Curve, first: number, last: number, place: Place): (Point | null)[] {
  const points: (Point | null)[] = [];
  let column: Point[] = [];
  const flush = () => {
    const by = (better: (a: number, b: number) => boolean) =>
      column.reduce((best, one, k) => (better(one[1], column[best]![1]) ? k : best), 0);
    const kept = new Set(column.length ? [0, by((a, b) => a < b), by((a, b) => a > b), column.length - 1] : []);
    points.push(...[...kept].sort((a, b) => a - b).map((k) => column[k]!));
    column = [];
  };
  for (let k = first; k <= last; k += 1) {
    const at = place(curve.t[k]!, curve.shown(curve.values[k]!));
    if (!at || (column[0] && Math.floor(at[0]) !== Math.floor(column[0][0]))) flush();
    if (at) column.push(at);
    else points.push(null);
  }
  flush();
  return points;
}
