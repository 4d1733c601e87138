// The programme of a cam as the panel edits it: segments, the knots between them, and what a dragged knot changes.

export const WAYS = ["rise", "dwell", "return"] as const;
export type Way = (typeof WAYS)[number];
export const LAWS = [
  "cycloidal",
  "harmonic",
  "modified_sine",
  "modified_trapezoid",
  "poly345",
  "poly4567",
  "linear",
] as const;
const TURN = 360;
/** The least angle of a segment that a drag leaves, degrees. */
const LEAST = 1;

export interface Segment {
  way: Way;
  /** Of the cam, degrees. */
  angle: number;
  /** The change of the lift, m or degrees; null for a return to no lift, and for dwells. */
  height: number | null;
  law: string;
}

/** The lift at the ends of the segments; the first is 0. */
export function levels(all: readonly Segment[]): number[] {
  let level = 0;
  const after = ({ way, height }: Segment) => {
    if (way === "rise") level += height ?? 0;
    if (way === "return") level = height === null ? 0 : level - height;
    return level;
  };
  return [0, ...all.map(after)];
}

/** The angles at which the segments end, degrees; the first is 0. */
export function ends(all: readonly Segment[]): number[] {
  let end = 0;
  const after = ({ angle }: Segment) => {
    end += angle;
    return end;
  };
  return [0, ...all.map(after)];
}

/** What a turn lacks, degrees; rounding errors are none. */
export function missing(all: readonly Segment[]): number {
  const lack = TURN - ends(all).at(-1)!;
  return Math.abs(lack) < 1e-9 * TURN ? 0 : lack;
}

/** A whole turn: a dwell is added, or the last segments are shortened. */
export function filled(all: readonly Segment[]): Segment[] {
  const made = all.map((one) => ({ ...one }));
  let lack = missing(made);
  const last = made.at(-1);
  if (lack > 0 && last?.way !== "dwell") made.push({ way: "dwell", angle: lack, height: null, law: LAWS[0] });
  else if (lack > 0) last!.angle += lack;
  while (lack < 0) {
    const end = made.at(-1)!;
    if (end.angle + lack > 0) {
      end.angle += lack;
      break;
    }
    lack += end.angle;
    made.pop();
  }
  return made;
}

/** The programme with the knot after the segment `k` at an angle and a lift. Dwells beside it keep their neighbour's
 * lift, and no segment changes its direction. */
export function dragged(all: readonly Segment[], k: number, angle: number, level: number): Segment[] {
  const made = all.map((one) => ({ ...one }));
  const [first, next] = [made[k]!, made[k + 1]!];
  const both = first.angle + next.angle;
  first.angle = Math.max(LEAST, Math.min(both - LEAST, angle - ends(all)[k]!));
  next.angle = both - first.angle;
  let [low, high] = [k, k + 1];
  while (all[low]?.way === "dwell") low -= 1;
  while (all[high]?.way === "dwell") high += 1;
  const [before, after] = [made[low], made[high]];
  if (!before || !after) return made;
  const known = levels(all);
  const fits = ({ way }: Segment, change: number) => (way === "rise" ? change > 0 : change < 0);
  const [to, on] = [level - known[low]!, known[high + 1]! - level];
  if (level < 0 || !fits(before, to) || !fits(after, on)) return made;
  before.height = Math.abs(to);
  if (after.height !== null) after.height = Math.abs(on);
  return made;
}
