// A motion on the screen whose page follows whether it goes on.
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
