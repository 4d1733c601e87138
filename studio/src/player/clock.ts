// The present time, and how it goes on while the motion is played.
import type { Motion } from "./motion";

/** A clock over the duration of a motion; calls `changed` whenever it moves, starts or stops. */
export class Clock {
  t: number;
  speed = 1;
  loop = false;
  playing = false;
  private last: number | null = null;

  constructor(
    private readonly motion: Motion,
    readonly rate: number,
    private readonly changed: () => void,
  ) {
    this.t = motion.begin;
  }

  seek(t: number): void {
    if (!Number.isFinite(t)) return;
    this.t = Math.min(this.motion.end, Math.max(this.motion.begin, t));
    this.changed();
  }

  /** Go on by so many frames, and stop there. */
  step(frames: number): void {
    this.pause();
    const times = this.motion.t;
    const { low, share } = this.motion.place(this.t);
    const here = share >= 1 ? low + 1 : low;
    const between = share > 0 && share < 1 && frames < 0 ? 1 : 0; // back to the frame just passed
    this.seek(times[Math.min(times.length - 1, Math.max(0, here + frames + between))]!);
  }

  play(): void {
    if (this.playing || this.motion.end <= this.motion.begin) return;
    if (this.t >= this.motion.end) this.t = this.motion.begin;
    this.playing = true;
    this.last = null;
    requestAnimationFrame((now) => this.tick(now));
    this.changed();
  }

  pause(): void {
    this.playing = false;
    this.changed();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  private tick(now: number): void {
    if (!this.playing) return;
    const elapsed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    this.t = this.after(Math.min(elapsed, 0.5)); // a hidden page gets no ticks
    if (this.t >= this.motion.end && !this.loop) this.playing = false;
    this.changed();
    if (this.playing) requestAnimationFrame((next) => this.tick(next));
  }

  private after(elapsed: number): number {
    const { begin, end } = this.motion;
    const t = this.t + elapsed * this.rate * this.speed;
    if (t < end) return t;
    return this.loop ? begin + ((t - begin) % (end - begin)) : end;
  }
}
