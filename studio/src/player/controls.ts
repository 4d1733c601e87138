// The controls of playback: buttons, the slider of time, speed.

import { playerTexts as texts } from "../texts";
import type { Clock } from "./clock";
import { byId } from "./elements";
import type { Motion } from "./motion";
import type { Scene } from "./scene";

const SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5, 10];
/** Controls that a single instant does not need. */
const MOVING = ["play", "first", "last", "back", "forward", "loop", "scrub", "speed"];

/** Buttons, slider and speed of a clock. */
export class Controls {
  private readonly scrub = byId<HTMLInputElement>("scrub");
  private readonly speed = byId<HTMLSelectElement>("speed");

  constructor(
    private readonly clock: Clock,
    private readonly motion: Motion,
    private readonly decimals: number,
    events: Scene["events"],
  ) {
    this.scrub.min = String(motion.begin);
    this.scrub.max = String(motion.end);
    this.scrub.addEventListener("input", () => clock.seek(Number(this.scrub.value)));
    for (const event of events) this.mark(event);
    this.connectSpeed();
    if (motion.t.length > 1) return;
    for (const id of MOVING) byId<HTMLButtonElement>(id).disabled = true;
  }

  /** A tick of an event below the slider, which has half a thumb of margin. */
  private mark({ name, t }: Scene["events"][number]): void {
    const tick = document.createElement("button");
    const share = (t - this.motion.begin) / (this.motion.end - this.motion.begin || 1);
    tick.type = "button";
    tick.className = "event";
    tick.title = `${name}: ${this.motion.written(t, this.decimals)}`;
    tick.setAttribute("aria-label", tick.title);
    tick.style.left = `calc(8px + ${share} * (100% - 16px))`;
    tick.addEventListener("click", () => this.clock.seek(t));
    byId("timeline").append(tick);
  }

  private connectSpeed(): void {
    for (const speed of SPEEDS) {
      const option = document.createElement("option");
      option.value = String(speed);
      option.textContent = `${Number((speed * this.clock.rate).toPrecision(3))}×`;
      this.speed.append(option);
    }
    this.speed.value = "1";
    this.speed.addEventListener("change", () => {
      this.clock.speed = Number(this.speed.value);
    });
  }

  changeSpeed(places: number): void {
    const place = SPEEDS.indexOf(this.clock.speed) + places;
    this.clock.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, place))]!;
    this.speed.value = String(this.clock.speed);
  }

  repeat(): void {
    this.clock.loop = !this.clock.loop;
    byId("loop").setAttribute("aria-pressed", String(this.clock.loop));
  }

  paint(): void {
    const written = this.motion.written(this.clock.t, this.decimals);
    byId("now").textContent = written;
    this.scrub.value = String(this.clock.t);
    this.scrub.setAttribute("aria-valuetext", written);
    const play = byId("play");
    play.classList.toggle("playing", this.clock.playing);
    play.setAttribute("aria-label", this.clock.playing ? texts.pause : texts.play);
  }
}
