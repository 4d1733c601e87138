// A motion on the screen: one call for each frame until it is stopped or has ended.

/** Whether a motion goes on, kept where its page sees it. */
export interface Flag {
  value: boolean;
}

/** Frames of one kind of motion. A newer start ends an older one, so that two never go on beside each other. */
export class Loop {
  private starts = 0;

  constructor(private readonly on: Flag) {}

  /** Call `each` with the ms since the frame before, until it returns false or the motion is stopped. */
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
