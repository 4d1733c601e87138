// A drag of a place that numbers of the text determine: the place follows the pointer as far as they allow it.
import type { Value } from "../core/protocol";
import { writtenAt } from "../edit/numerals";
import { written } from "../edit/values";
import { distance, type Point } from "../plane/points";
import { Draft } from "../store/document";
import { view } from "../store/sheet";
import { problems, tree, unassembled } from "../store/state";
import { changesFor, type Grasp, type Knob, placeOf } from "./knobs";

/** Values are rounded so that the place is within this distance of the pointer, px. */
const ROUNDING = 2;
/** A place within this distance needs no further step, px. */
const NEAR = 1;
/** Steps toward one place of the pointer. */
const STEPS = 6;
/** A drag within this angle of the way of one number changes only this number, rad. */
const ALONG = 0.2;

export class Follower {
  private readonly draft = new Draft();
  private values: number[];
  private columns: Point[];
  private goal: Point | null = null;
  private working: Promise<void> | null = null;
  /** The last end of the drag. */
  end: Point;

  /** Follow with one or two numbers of a grasp. */
  constructor(
    readonly grasp: Grasp,
    readonly knobs: readonly Knob[],
    private readonly shown: () => void,
  ) {
    this.values = knobs.map(({ value }) => value);
    this.columns = knobs.map(({ column }) => column);
    this.end = grasp.at;
  }

  to(goal: Point): void {
    this.end = this.goal = goal;
    this.working ??= this.work();
  }

  async keep(): Promise<void> {
    await this.working;
    await this.draft.keep();
  }

  async drop(): Promise<void> {
    this.goal = null;
    await this.working;
    await this.draft.drop();
  }

  /** The numbers that differ from those before the drag. */
  get changed(): Knob[] {
    return this.knobs.filter(({ value }, k) => this.values[k] !== value);
  }

  /** The changed numbers as people read them, such as `L1 = 10.7`. */
  get label(): string {
    const plain = this.changed.filter(({ numeral }) => !numeral);
    const texts = this.changed.flatMap(({ label, numeral }) => {
      if (!numeral) return [];
      const now = writtenAt(tree.value, numeral);
      return [`${label} = ${written(numeral.index === null ? now : (now as Value[])[numeral.index])}`];
    });
    return [...(plain.length ? [plain[0]!.label] : []), ...texts].join("   ");
  }

  private async work(): Promise<void> {
    while (this.goal) {
      const goal = this.goal;
      this.goal = null;
      for (let k = 0; k < STEPS && !this.goal; k += 1) if (!(await this.approach(goal))) break;
      this.shown();
    }
    this.working = null;
  }

  private get at(): Point {
    return placeOf(this.grasp) ?? this.grasp.at;
  }

  /** One step toward a place; false if it is reached or cannot be approached. */
  private async approach(goal: Point): Promise<boolean> {
    const before = this.values;
    const from = this.at;
    const next = this.solved(goal, from);
    if (next.every((one, k) => one === before[k])) return false;
    const far = distance(goal, from);
    for (const share of [1, 0.5, 0.25, 0.1]) {
      const values = next.map((one, k) => this.rounded(before[k]! + share * (one - before[k]!), k));
      await this.set(values);
      const isBack = this.offKnobs(before, next);
      if (!unassembled.value && !problems.value.length && (isBack || distance(goal, this.at) < 1.02 * far)) {
        this.learn(before, from);
        return distance(goal, this.at) * view.scale > NEAR;
      }
    }
    await this.set(before);
    return false;
  }

  /** Whether a number returns to its first value, because the drag now follows another one. */
  private offKnobs(before: readonly number[], next: readonly number[]): boolean {
    return this.knobs.some(({ value }, k) => next[k] === value && before[k] !== value);
  }

  private async set(values: number[]): Promise<void> {
    this.values = values;
    await this.draft.apply(changesFor(this.grasp, this.knobs, values));
  }

  /** The values that bring the place to the pointer, or nearest to it, by the present velocities. */
  private solved(goal: Point, from: Point): number[] {
    const used = this.used(goal);
    const values = this.values.map((one, k) => (used.includes(k) ? one : this.knobs[k]!.value));
    const [dx, dy] = [0, 1].map((axis) =>
      this.columns.reduce(
        (sum, column, k) => sum - column[axis]! * (values[k]! - this.values[k]!),
        goal[axis]! - from[axis]!,
      ),
    ) as Point;
    const steps = used.length === 2 ? both(this.columns, dx, dy) : [along(this.columns[used[0]!]!, dx, dy)];
    used.forEach((k, n) => (values[k] = this.rounded(values[k]! + steps[n]!, k)));
    return values;
  }

  /** Which numbers change: a drag along the way of one of them changes it alone. */
  private used(goal: Point): number[] {
    const all = this.columns.map((_, k) => k);
    if (all.length < 2 || !this.knobs[0]!.numeral) return all;
    const way: Point = [goal[0] - this.grasp.at[0], goal[1] - this.grasp.at[1]];
    const one = this.knobs.findIndex(({ column: [x, y] }) => {
      const turn = Math.abs(way[0] * y - way[1] * x);
      return turn < Math.sin(ALONG) * Math.hypot(...way) * Math.hypot(x, y);
    });
    return one < 0 ? all : [one];
  }

  /** Improve the velocities by what a step has done (Broyden's method). */
  private learn(before: readonly number[], from: Point): void {
    const lengths = this.columns.map((column) => Math.hypot(...column));
    const steps = this.values.map((one, k) => (one - before[k]!) * lengths[k]!);
    const square = steps.reduce((sum, one) => sum + one * one, 0);
    if (!(square > 0)) return;
    const now = this.at;
    const miss = [0, 1].map(
      (axis) =>
        now[axis]! -
        from[axis]! -
        this.columns.reduce((sum, column, k) => sum + (column[axis]! * steps[k]!) / lengths[k]!, 0),
    );
    this.columns = this.columns.map(
      (column, k) => [0, 1].map((axis) => column[axis]! + (miss[axis]! * steps[k]! * lengths[k]!) / square) as Point,
    );
  }

  /** A value with the digits that can be seen. */
  private rounded(value: number, k: number): number {
    const step = ROUNDING / (view.scale * Math.hypot(...this.knobs[k]!.column));
    const digits = -Math.floor(Math.log10(step));
    return digits > 0 ? Number(value.toFixed(Math.min(15, digits))) : Math.round(value * 10 ** digits) / 10 ** digits;
  }
}

function both([first, second]: Point[], dx: number, dy: number): number[] {
  const [[a, c], [b, d]] = [first!, second!];
  const det = a * d - b * c;
  return [(d * dx - b * dy) / det, (a * dy - c * dx) / det];
}

function along([x, y]: Point, dx: number, dy: number): number {
  return (x * dx + y * dy) / (x * x + y * y);
}
