// The part of the time that plots show.

/** A window of time within a motion; all plots share it. */
export class TimeSpan {
  constructor(motion) {
    this.motion = motion;
    this.showAll();
  }

  showAll() {
    this.from = this.motion.begin;
    this.to = this.motion.end;
  }

  /** Show `factor` times as much time around t. */
  stretch(factor, t) {
    const { begin, end } = this.motion;
    const [from, to] = [this.from, this.to].map((edge) => t + (edge - t) * factor);
    if (to - from < 1e-6 * (end - begin)) return;
    this.from = Math.max(begin, from);
    this.to = Math.min(end, to);
  }

  /** Move the window so that it holds t. */
  follow(t) {
    if (t >= this.from && t <= this.to) return;
    const length = this.to - this.from;
    this.from = Math.min(Math.max(t - 0.1 * length, this.motion.begin), this.motion.end - length);
    this.to = this.from + length;
  }
}
