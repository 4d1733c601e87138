// The axes of a plot: which values they hold, where a value is, and how ticks are written.
import { decades, ticks } from "./numbers.js";
import { font } from "./surface.js";

const TOP = 32;
const BOTTOM = 40;
const RIGHT = 14;
const TICK_TEXT = 12;

/** Axes of a plot of a size, px, over a span of time. */
export class Axes {
  constructor(context, { width, height }, span, { range, log, divisor }) {
    Object.assign(this, { width, height, span, range, log, divisor });
    const count = Math.max(2, Math.floor((height - TOP - BOTTOM) / 36));
    this.up = log ? decades(...range, count) : ticks(...range, count);
    context.font = font(TICK_TEXT);
    const widest = Math.max(...this.up.values.map((value) => context.measureText(this.up.write(value)).width));
    this.left = Math.ceil(Math.max(34, widest + 16));
    this.across = ticks(span.from / divisor, span.to / divisor, Math.max(2, Math.floor((width - this.left) / 90)));
  }

  /** Where a time and a value (of the logarithm on a logarithmic axis) are, px. */
  place(t, value) {
    const { span, range, width, height, left } = this;
    const share = span.to > span.from ? (t - span.from) / (span.to - span.from) : 0;
    const rise = (value - range[0]) / (range[1] - range[0]);
    return [left + share * (width - left - RIGHT), height - BOTTOM - rise * (height - TOP - BOTTOM)];
  }

  /** The time under a place, px from the left. */
  timeAt(px) {
    const share = (px - this.left) / Math.max(1, this.width - this.left - RIGHT);
    return this.span.from + Math.min(1, Math.max(0, share)) * (this.span.to - this.span.from);
  }

  /** Keep what is painted next between the axes. */
  clip(context) {
    context.beginPath();
    context.rect(this.left - 2, TOP - 8, this.width - this.left - RIGHT + 4, this.height - TOP - BOTTOM + 12);
    context.clip();
  }

  paint(context, label, colours) {
    context.lineWidth = 1;
    context.font = font(TICK_TEXT);
    context.fillStyle = colours.soft;
    this.paintUp(context, colours);
    this.paintAcross(context, colours);
    context.fillStyle = colours.text;
    context.textAlign = "center";
    context.textBaseline = "alphabetic";
    context.fillText("t / s", (this.left + this.width - RIGHT) / 2, this.height - 5);
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(label, 10, 7);
  }

  paintUp(context, colours) {
    context.strokeStyle = colours.grid;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of this.up.values) {
      const y = Math.round(this.place(this.span.from, value)[1]) + 0.5;
      context.stroke(new Path2D(`M${this.left} ${y}H${this.width - RIGHT}`));
      context.fillText(this.up.write(value), this.left - 8, y);
    }
  }

  /** Ticks of time; the last one is moved to the left where it would be cut. */
  paintAcross(context, colours) {
    const base = this.height - BOTTOM;
    context.strokeStyle = colours.edge;
    context.textAlign = "center";
    context.textBaseline = "top";
    context.stroke(new Path2D(`M${this.left} ${base + 0.5}H${this.width - RIGHT}`));
    for (const value of this.across.values) {
      const x = Math.round(this.place(value * this.divisor, this.range[0])[0]) + 0.5;
      const text = this.across.write(value);
      const half = context.measureText(text).width / 2 + 2;
      context.stroke(new Path2D(`M${x} ${base}v5`));
      context.fillText(text, Math.min(x, this.width - half), base + 8);
    }
  }

  /** A line up at t. */
  line(context, t) {
    const x = this.place(t, this.range[0])[0];
    context.stroke(new Path2D(`M${x} ${TOP - 6}V${this.height - BOTTOM}`));
  }
}
