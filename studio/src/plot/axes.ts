// The axes of a plot: their ranges, the places of values, and the ticks.
import { Line } from "../draw/line";
import { axisLabel } from "../draw/numbers";
import { type Colours, font } from "../draw/surface";
import { angleTicks, decades, type Ticks, ticks } from "../draw/ticks";
import type { Point } from "../plane/points";
import type { Across } from "./curve";
import type { TimeSpan } from "./timespan";

const TOP = 32;
const BOTTOM = 40;
const RIGHT = 14;
const TICK_TEXT = 12;

/** The size of a plot, px. */
export interface Size {
  width: number;
  height: number;
}

/** The vertical axis: a range of values or exponents, and their unit. */
export interface Held {
  range: Point;
  log: boolean;
  unit: string;
}

/** The rule of ticks for values of a unit. */
function inUnit(unit: string): typeof ticks {
  return unit === "°" ? angleTicks : ticks;
}

/** Axes of a plot of a size over a span of time. */
export class Axes {
  private readonly left: number;
  private readonly up: Ticks;
  private readonly along: Ticks;

  constructor(
    context: CanvasRenderingContext2D,
    private readonly size: Size,
    private readonly span: TimeSpan,
    private readonly across: Across,
    private readonly held: Held,
  ) {
    const { range, log, unit } = held;
    const count = Math.max(2, Math.floor((size.height - TOP - BOTTOM) / 36));
    this.up = log ? decades(...range, count) : inUnit(unit)(...range, count);
    context.font = font(TICK_TEXT);
    const widest = Math.max(...this.up.values.map((value) => context.measureText(this.up.write(value)).width));
    this.left = Math.ceil(Math.max(34, widest + 16));
    const most = Math.max(2, Math.floor((size.width - this.left) / 90));
    const { divisor, shown } = across;
    this.along = inUnit(shown)(span.from / divisor, span.to / divisor, most);
  }

  /** The place of a time and a value (or its logarithm, on a logarithmic axis), px. */
  place(t: number, value: number): Point {
    const { from, to } = this.span;
    const { width, height } = this.size;
    const [low, high] = this.held.range;
    const share = to > from ? (t - from) / (to - from) : 0;
    const rise = (value - low) / (high - low);
    return [this.left + share * (width - this.left - RIGHT), height - BOTTOM - rise * (height - TOP - BOTTOM)];
  }

  /** The time under a place, px from the left. */
  timeAt(px: number): number {
    const share = (px - this.left) / Math.max(1, this.size.width - this.left - RIGHT);
    return this.span.from + Math.min(1, Math.max(0, share)) * (this.span.to - this.span.from);
  }

  /** Clip later painting to the area between the axes. */
  clip(context: CanvasRenderingContext2D): void {
    const { width, height } = this.size;
    context.beginPath();
    context.rect(this.left - 2, TOP - 8, width - this.left - RIGHT + 4, height - TOP - BOTTOM + 12);
    context.clip();
  }

  /** Paint axes and ticks, with the label at the upper left and the note at the upper right. */
  paint(context: CanvasRenderingContext2D, label: string, note: string, colours: Colours): void {
    const { width, height } = this.size;
    context.lineWidth = 1;
    context.font = font(TICK_TEXT);
    context.fillStyle = colours.named.soft;
    this.paintUp(context, colours);
    this.paintAcross(context, colours);
    context.fillStyle = colours.named.text;
    context.textAlign = "center";
    context.textBaseline = "alphabetic";
    context.fillText(axisLabel(this.across.name, this.across.shown), (this.left + width - RIGHT) / 2, height - 5);
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(label, 10, 7);
    const room = width - RIGHT - 24 - context.measureText(label).width;
    context.fillStyle = colours.named.soft;
    context.textAlign = "right";
    if (note) context.fillText(note, width - RIGHT, 7, Math.max(1, room));
  }

  private paintUp(context: CanvasRenderingContext2D, colours: Colours): void {
    context.strokeStyle = colours.named.grid;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of this.up.values) {
      const y = Math.round(this.place(this.span.from, value)[1]) + 0.5;
      context.stroke(new Line(`M${this.left} ${y}H${this.size.width - RIGHT}`));
      context.fillText(this.up.write(value), this.left - 8, y);
    }
  }

  /** Ticks of the horizontal axis. The last one is moved to the left if the edge would cut it. */
  private paintAcross(context: CanvasRenderingContext2D, colours: Colours): void {
    const { width, height } = this.size;
    const base = height - BOTTOM;
    context.strokeStyle = colours.named.edge;
    context.textAlign = "center";
    context.textBaseline = "top";
    context.stroke(new Line(`M${this.left} ${base + 0.5}H${width - RIGHT}`));
    for (const value of this.along.values) {
      const x = Math.round(this.place(value * this.across.divisor, this.held.range[0])[0]) + 0.5;
      const text = this.along.write(value);
      const half = context.measureText(text).width / 2 + 2;
      context.stroke(new Line(`M${x} ${base}v5`));
      context.fillText(text, Math.min(x, width - half), base + 8);
    }
  }

  /** A vertical line at t. */
  line(context: CanvasRenderingContext2D, t: number): void {
    const [x] = this.place(t, this.held.range[0]);
    context.stroke(new Line(`M${x} ${TOP - 6}V${this.size.height - BOTTOM}`));
  }
}
