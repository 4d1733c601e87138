// The part of the time that plots show.
import type { Motion } from "./motion";

/** A window of time within a motion; all plots share it. */
export class TimeSpan {
  from: number;
  to: number;

  constructor(private readonly motion: Motion) {
    this.from = motion.begin;
    this.to = motion.end;
  }

  showAll(): void {
    this.from = this.motion.begin;
    this.to = this.motion.end;
  }

  /** Show `factor` times as much time around t. */
  stretch(factor: number, t: number): void {
    const { begin, end } = this.motion;
    const [from, to] = [t + (this.from - t) * factor, t + (this.to - t) * factor];
    if (to - from < 1e-6 * (end - begin)) return;
    this.from = Math.max(begin, from);
    this.to = Math.min(end, to);
  }

  /** Move the window so that it holds t. */
  follow(t: number): void {
    if (t >= this.from && t <= this.to) return;
    const length = this.to - this.from;
    this.from = Math.min(Math.max(t - 0.1 * length, this.motion.begin), this.motion.end - length);
    this.to = this.from + length;
  }
}
