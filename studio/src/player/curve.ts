// A quantity over time.
import type { Curve } from "../plot/curve";
import type { Motion } from "./motion";

/** The source of a curve: its owner, key and unit, its number among curves of the same kind, and its values. */
export interface Source {
  subject: string;
  key: string;
  unit: string;
  /** Decides the colour and the dashes. */
  number: number;
  sample(k: number): number;
  /** The derivative, if it is a quantity too. */
  rate?: SceneCurve | undefined;
}

/** Values of a quantity at the frames and between them, computed on first use. */
export class SceneCurve implements Curve {
  readonly name: string;
  readonly stored = false;
  /** Numbers below this are rounding errors. */
  noise = 0;
  private kept: number[] | null = null;
  private keptSlopes: number[] | null = null;

  constructor(
    private readonly motion: Motion,
    private readonly source: Source,
  ) {
    this.name = source.key ? `${source.subject}.${source.key}` : source.subject;
  }

  get subject(): string {
    return this.source.subject;
  }

  get t(): number[] {
    return this.motion.t;
  }

  get smooth(): boolean {
    return this.motion.smooth;
  }

  get unit(): string {
    return this.source.unit;
  }

  get number(): number {
    return this.source.number;
  }

  /** Values at the frames, as in the solution. */
  get values(): number[] {
    this.kept ??= this.motion.t.map((_, k) => this.source.sample(k));
    return this.kept;
  }

  get slopes(): number[] {
    this.keptSlopes ??= this.source.rate ? this.source.rate.values : this.motion.slopes(this.values);
    return this.keptSlopes;
  }

  /** The value at t; rounding errors are shown as zero. */
  at(t: number): number {
    return this.shown(this.motion.value(this, t));
  }

  shown(value: number): number {
    return Math.abs(value) < this.noise ? 0 : value;
  }
}
