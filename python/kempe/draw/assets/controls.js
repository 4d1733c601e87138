// The controls of playback: buttons, the slider of time, speed.

const SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5, 10];

/** Buttons, slider and speed of a clock. */
export class Controls {
  constructor(find, clock, motion, decimals, events) {
    Object.assign(this, { find, clock, motion, decimals });
    this.connectSlider();
    for (const event of events) this.mark(event);
    this.connectSpeed(clock.rate);
    if (motion.t.length > 1) return;
    for (const id of ["play", "first", "last", "back", "forward", "loop", "scrub", "speed"]) find(id).disabled = true;
  }

  connectSlider() {
    const scrub = this.find("scrub");
    scrub.min = String(this.motion.begin);
    scrub.max = String(this.motion.end);
    scrub.addEventListener("input", () => this.clock.seek(Number(scrub.value)));
  }

  /** A tick of an event below the slider, which has half a thumb of margin. */
  mark({ name, t }) {
    const tick = document.createElement("button");
    const share = (t - this.motion.begin) / (this.motion.end - this.motion.begin || 1);
    tick.type = "button";
    tick.className = "event";
    tick.title = `${name}: ${this.motion.written(t, this.decimals)}`;
    tick.setAttribute("aria-label", tick.title);
    tick.style.left = `calc(8px + ${share} * (100% - 16px))`;
    tick.addEventListener("click", () => this.clock.seek(t));
    this.find("timeline").append(tick);
  }

  connectSpeed(rate) {
    const select = this.find("speed");
    for (const speed of SPEEDS) {
      const option = document.createElement("option");
      option.value = String(speed);
      option.textContent = `${Number((speed * rate).toPrecision(3))}×`;
      select.append(option);
    }
    select.value = "1";
    select.addEventListener("change", () => {
      this.clock.speed = Number(select.value);
    });
  }

  changeSpeed(places) {
    const place = SPEEDS.indexOf(this.clock.speed) + places;
    this.clock.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, place))];
    this.find("speed").value = String(this.clock.speed);
  }

  toggle() {
    if (this.clock.playing) this.clock.pause();
    else this.clock.play();
  }

  repeat() {
    this.clock.loop = !this.clock.loop;
    this.find("loop").setAttribute("aria-pressed", String(this.clock.loop));
  }

  paint() {
    const written = this.motion.written(this.clock.t, this.decimals);
    this.find("now").textContent = written;
    const scrub = this.find("scrub");
    scrub.value = String(this.clock.t);
    scrub.setAttribute("aria-valuetext", written);
    const play = this.find("play");
    play.classList.toggle("playing", this.clock.playing);
    play.setAttribute("aria-label", this.clock.playing ? "Pause" : "Play");
  }
}
