// Runs a motion on the screen: one call for each frame until the motion ends or is stopped.

/** True while a motion runs. The page supplies the flag, so that it can follow it. */
export interface Flag {
  value: boolean;
}

/** The frames of one kind of motion. A new start ends the previous motion, so that never two run at a time. */
export class Loop {
  private starts = 0;

  constructor(private readonly on: Flag) {}

  /** Call `each` with the ms since the previous frame, until it returns false or the motion is stopped. */
  async play(each: (ms: number) => boolean | Promise<boolean>, begin?: () => Promise<void>): Promise<void> {
    if (this.on.value) return;
    this.on.value = true;
    this.starts += 1;
    const own = this.starts;
    const goesOn = () => this.on.value && this.starts === own;
    try {
      await begin?.();
      let last = performance.now();
      while (goesOn()) {
        const now = await new Promise<number>((done) => requestAnimationFrame(done));
        const ms = Math.max(0, now - last);
        last = now;
        if (!goesOn() || !(await each(ms))) break;
      }
    } finally {
      if (this.starts === own) this.on.value = false;
    }
  }

  stop(): void {
    this.on.value = false;
  }
}
