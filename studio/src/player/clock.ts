// The present time, which advances while the motion plays.
import { Loop } from "../draw/loop";
import type { Motion } from "./motion";

/** A clock over the duration of a motion; calls `changed` whenever it moves, starts or stops. */
export class Clock {
  t: number;
  speed = 1;
  loop = false;
  private readonly on = { value: false };
  private readonly frames = new Loop(this.on);

  constructor(
    private readonly motion: Motion,
    readonly rate: number,
    private readonly changed: () => void,
  ) {
    this.t = motion.begin;
  }

  get playing(): boolean {
    return this.on.value;
  }

  seek(t: number): void {
    if (!Number.isFinite(t)) return;
    this.t = Math.min(this.motion.end, Math.max(this.motion.begin, t));
    this.changed();
  }

  /** Move by a number of frames, and stop. */
  step(frames: number): void {
    this.pause();
    const times = this.motion.t;
    const { low, share } = this.motion.place(this.t);
    const here = share >= 1 ? low + 1 : low;
    const between = share > 0 && share < 1 && frames < 0 ? 1 : 0; // back to the last frame
    this.seek(times[Math.min(times.length - 1, Math.max(0, here + frames + between))]!);
  }

  play(): void {
    if (this.playing || this.motion.end <= this.motion.begin) return;
    if (this.t >= this.motion.end) this.t = this.motion.begin;
    void this.frames.play((ms) => this.tick(ms)).then(this.changed);
    this.changed();
  }

  pause(): void {
    this.frames.stop();
    this.changed();
  }

  toggle(): void {
    if (this.playing) this.pause();
    else this.play();
  }

  /** Advance by one frame of the screen; false at the end. */
  private tick(ms: number): boolean {
    this.t = this.after(Math.min(ms, 500) / 1000); // a hidden page gets no frames
    this.changed();
    return this.loop || this.t < this.motion.end;
  }

  private after(elapsed: number): number {
    const { begin, end } = this.motion;
    const t = this.t + elapsed * this.rate * this.speed;
    if (t < end) return t;
    return this.loop ? begin + ((t - begin) % (end - begin)) : end;
  }
}
