// All plots of the page: they share the time, its window and the units of angles.
import type { Units } from "../draw/display";
import type { Colours } from "../draw/surface";
import { type Seeking, seekable } from "../plot/gestures";
import type { Plot } from "../plot/plot";
import { TimeSpan } from "../plot/timespan";
import { Card, type Templates } from "./card";
import type { Motion } from "./motion";
import { drivenMotion, type Quantity, quantities } from "./quantities";
import type { Scene } from "./scene";

const MOST = 6;

interface Calls {
  seek(t: number): void;
  changed(): void;
  /** Called with true while another plot may be added. */
  counted(more: boolean): void;
}

/** The list of plots. */
export class Plots {
  cards: Card[] = [];
  readonly all: Quantity[];
  private looked: number | null = null;
  private units: Units = { degrees: true, length: "m" };
  private readonly span: TimeSpan;
  private readonly watch: ResizeObserver;

  constructor(
    private readonly list: HTMLElement,
    private readonly templates: Templates,
    private readonly scene: Scene,
    private readonly motion: Motion,
    private readonly calls: Calls,
  ) {
    this.span = new TimeSpan(motion);
    this.all = quantities(scene, motion);
    this.watch = new ResizeObserver(() => {
      this.resize();
      calls.changed();
    });
  }

  /** Add a plot: first the motion of a driven body, if any, and then the first quantity that no other shows. */
  add(): void {
    if (this.cards.length >= MOST || !this.all.length) return;
    const shown = new Set(this.cards.map(({ quantity }) => Number(quantity.value)));
    const next = this.all.findIndex((_, k) => !shown.has(k));
    const card = new Card(this.templates, this.all, this.motion, this.span, this.calls.changed);
    card.removal.addEventListener("click", () => this.remove(card));
    card.plot.units = this.units;
    this.cards.push(card);
    this.list.append(card.element);
    this.watch.observe(card.canvas);
    seekable(card.canvas, this.seeking(card.plot));
    card.choose(...(this.cards.length === 1 ? drivenMotion(this.scene, this.all) : ([Math.max(0, next), 0] as const)));
    this.update();
  }

  private seeking(plot: Plot): Seeking {
    const { changed, seek } = this.calls;
    return {
      timeAt: (px) => plot.timeAt(px),
      seek,
      look: (at) => {
        plot.pointer = at;
        this.looked = at && this.motion.t[this.motion.nearest(plot.timeAt(at[0]))]!;
        changed();
      },
      stretch: (factor, px) => {
        this.span.stretch(factor, plot.timeAt(px));
        changed();
      },
      showAll: () => {
        this.span.showAll();
        changed();
      },
    };
  }

  private remove(card: Card): void {
    this.watch.unobserve(card.canvas);
    this.cards = this.cards.filter((one) => one !== card);
    card.element.remove();
    this.update();
    this.cards[0]!.quantity.focus();
    this.calls.changed();
  }

  private update(): void {
    for (const { removal } of this.cards) removal.hidden = this.cards.length < 2;
    this.calls.counted(this.cards.length < MOST);
    this.resize();
  }

  setDegrees(degrees: boolean): void {
    this.units = { ...this.units, degrees };
    for (const { plot } of this.cards) {
      plot.units = this.units;
      plot.scale();
    }
    this.calls.changed();
  }

  private resize(): void {
    for (const { plot } of this.cards) plot.resize();
  }

  paint(t: number, colours: Colours): void {
    this.span.follow(t);
    for (const card of this.cards) card.paint(t, this.looked, colours);
  }
}
