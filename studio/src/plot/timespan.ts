// The visible part of the horizontal axis of plots.

export interface Ends {
  readonly begin: number;
  readonly end: number;
}

/** A window within the ends of a motion; all plots share it. */
export class TimeSpan {
  from: number;
  to: number;

  constructor(private readonly ends: Ends) {
    this.from = ends.begin;
    this.to = ends.end;
  }

  showAll(): void {
    this.from = this.ends.begin;
    this.to = this.ends.end;
  }

  /** Multiply the visible time by `factor` around t. */
  stretch(factor: number, t: number): void {
    const { begin, end } = this.ends;
    const [from, to] = [t + (this.from - t) * factor, t + (this.to - t) * factor];
    if (to - from < 1e-6 * (end - begin)) return;
    this.from = Math.max(begin, from);
    this.to = Math.min(end, to);
  }

  /** Move the window so that it holds t. */
  follow(t: number): void {
    if (t >= this.from && t <= this.to) return;
    const { begin, end } = this.ends;
    const length = this.to - this.from;
    this.from = Math.min(Math.max(t - 0.1 * length, begin), end - length);
    this.to = this.from + length;
  }
}
