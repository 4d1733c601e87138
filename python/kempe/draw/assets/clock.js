// The present time, and how it goes on while the motion is played.

/** A clock over the duration of a motion; calls `changed` whenever it moves, starts or stops. */
export class Clock {
  constructor(motion, rate, changed) {
    this.motion = motion;
    this.rate = rate;
    this.changed = changed;
    this.t = motion.begin;
    this.speed = 1;
    this.loop = false;
    this.playing = false;
    this.last = null;
  }

  seek(t) {
    if (!Number.isFinite(t)) return;
    this.t = Math.min(this.motion.end, Math.max(this.motion.begin, t));
    this.changed();
  }

  /** Go on by so many frames, and stop there. */
  step(frames) {
    this.pause();
    const times = this.motion.t;
    const { low, share } = this.motion.place(this.t);
    const here = share >= 1 ? low + 1 : low;
    const between = share > 0 && share < 1 && frames < 0 ? 1 : 0; // back to the frame just passed
    this.seek(times[Math.min(times.length - 1, Math.max(0, here + frames + between))]);
  }

  play() {
    if (this.playing || this.motion.end <= this.motion.begin) return;
    if (this.t >= this.motion.end) this.t = this.motion.begin;
    this.playing = true;
    this.last = null;
    requestAnimationFrame((now) => this.tick(now));
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  tick(now) {
    if (!this.playing) return;
    const elapsed = this.last === null ? 0 : (now - this.last) / 1000;
    this.last = now;
    this.t = this.after(Math.min(elapsed, 0.5)); // a hidden page gets no ticks
    if (this.t >= this.motion.end && !this.loop) this.playing = false;
    this.changed();
    if (this.playing) requestAnimationFrame((next) => this.tick(next));
  }

  after(elapsed) {
    const { begin, end } = this.motion;
    const t = this.t + elapsed * this.rate * this.speed;
    if (t < end) return t;
    return this.loop ? begin + ((t - begin) % (end - begin)) : end;
  }
}
