// A motion on the screen with a signal that is true while it plays.
import { type ReadonlySignal, signal } from "@preact/signals";
import { Loop } from "../draw/loop";

export class Frames extends Loop {
  readonly playing: ReadonlySignal<boolean>;

  constructor() {
    const on = signal(false);
    super(on);
    this.playing = on;
  }
}
