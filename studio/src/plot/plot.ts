// A plot of curves of one unit, with a cursor at the present time and the value under the pointer.
import { conditionOf } from "../draw/condition";
import { displayed, type Units } from "../draw/display";
import { circle } from "../draw/line";
import { axisLabel, besideUnit, fixed, readable, scaled, significant } from "../draw/numbers";
import { type Colours, cleared, colourOf, dashOf, font, rimmed, sharpen } from "../draw/surface";
import type { Point } from "../plane/points";
import { Axes } from "./axes";
import { type Across, type Curve, shownValues } from "./curve";
import { lineOf, type Place } from "./line";
import { exponents, widened } from "./ranges";
import type { TimeSpan } from "./timespan";

const STORED = { dash: [6, 5], width: 1.3 };
const WIDTH = 1.8;

/** Plots curves of one unit on a canvas. */
export class Plot {
  curves: readonly Curve[] = [];
  log = false;
  units: Units = { degrees: false, length: "m" };
  /** The position of the pointer, px; null outside the plot. */
  pointer: Point | null = null;
  width = 0;
  height = 0;
  label = "";
  reading = "";
  range: Point = [0, 1];
  private symbol = "";
  private unit = "";
  private factor = 1;
  private peaks: number[] = [];
  private onLog = false;
  private version = 0;
  private axes: Axes | null = null;
  private kept: { key: string; picture: HTMLCanvasElement } | null = null;

  constructor(
    readonly canvas: HTMLCanvasElement,
    private span: TimeSpan,
    private across: Across,
  ) {
    this.scale();
  }

  /** Show these curves. */
  show(curves: readonly Curve[], symbol: string): void {
    this.curves = curves;
    this.symbol = symbol;
    this.scale();
  }

  /** What the values contain in a motion over a quantity; empty for positions and rates, and over time. */
  get note(): string {
    return conditionOf(this.curves[0]?.unit ?? "", this.across.condition);
  }

  /** Set the quantity on the horizontal axis and the part of it that is shown. */
  over(span: TimeSpan, across: Across): void {
    this.span = span;
    this.across = across;
    this.version += 1;
  }

  /** Choose units and ranges for the curves. */
  scale(): void {
    const { factor, unit } = displayed(readable(this.curves[0]?.unit ?? ""), this.units);
    const values = this.curves.map((curve) =>
      shownValues(curve)
        .map((value) => factor * value)
        .filter(Number.isFinite),
    );
    const peaks = values.map((all) => all.reduce((most, value) => Math.max(most, Math.abs(value)), 0));
    const peak = Math.max(0, ...peaks);
    const written = this.log && peak > 0 ? { factor: 1, unit } : scaled(peak, unit);
    this.factor = factor / written.factor;
    this.peaks = peaks.map((one) => one / written.factor);
    this.unit = written.unit;
    this.onLog = this.log && peak > 0;
    this.version += 1;
    this.range = this.onLog ? exponents(values) : widened(values, written.factor);
    this.label = axisLabel(this.onLog && !this.symbol.startsWith("|") ? `|${this.symbol}|` : this.symbol, this.unit);
  }

  resize(): void {
    sharpen(this.canvas);
    const { width, height } = this.canvas.getBoundingClientRect();
    this.width = width;
    this.height = height;
  }

  /** A value of a curve in the unit of the axis. */
  private shown(curve: Curve, t: number): number {
    return this.factor * curve.at(t);
  }

  private peakOf(curve: Curve): number {
    return this.peaks[this.curves.indexOf(curve)]!;
  }

  /** A value as text with its unit: on a linear axis with the decimals of its curve. */
  write(curve: Curve, t: number): string {
    const value = this.shown(curve, t);
    return besideUnit(this.onLog ? significant(value) : fixed(value, this.peakOf(curve)), this.unit);
  }

  /** Characters of the longest text of a curve. */
  widest(curve: Curve): number {
    const peak = this.peakOf(curve);
    return besideUnit(this.onLog ? significant(-peak) : fixed(-peak, peak), this.unit).length;
  }

  timeAt(px: number): number {
    return this.axes ? this.axes.timeAt(px) : this.span.from;
  }

  /** Draw with the cursor at t, and with a line at `looked`, the time under the pointer. */
  paint(t: number, looked: number | null, colours: Colours): void {
    const context = cleared(this.canvas);
    if (!this.curves.length || !this.width) return;
    context.drawImage(this.picture(colours), 0, 0, this.width, this.height);
    this.paintLine(context, t, colours.named.text);
    if (looked !== null) this.paintLine(context, looked, colours.named.accent);
    this.paintDots(context, looked ?? t, colours);
    this.reading = looked !== null && this.pointer ? this.paintReading(context, looked, this.pointer, colours) : "";
  }

  /** Axes and curves as a picture, which is painted again only after a change. */
  private picture(colours: Colours): HTMLCanvasElement {
    const { width, height, canvas, span, version } = this;
    const key = JSON.stringify([width, height, canvas.width, span.from, span.to, version, colours.named.text]);
    if (this.kept?.key !== key) {
      const picture = document.createElement("canvas");
      picture.width = canvas.width;
      picture.height = canvas.height;
      const context = picture.getContext("2d")!;
      context.scale(picture.width / width, picture.height / height);
      context.lineCap = "round";
      context.lineJoin = "round";
      this.paintStill(context, colours);
      this.kept = { key, picture };
    }
    return this.kept.picture;
  }

  private paintStill(context: CanvasRenderingContext2D, colours: Colours): void {
    const held = { range: this.range, log: this.onLog, unit: this.unit };
    this.axes = new Axes(context, this, this.span, this.across, held);
    this.axes.paint(context, this.label, this.note, colours);
    context.save();
    this.axes.clip(context);
    for (const curve of this.curves) this.paintCurve(context, curve, colours);
    context.restore();
  }

  /** For a picture: axes, curves and the cursor at t. */
  paintAll(context: CanvasRenderingContext2D, t: number, colours: Colours): void {
    this.paintStill(context, colours);
    this.paintLine(context, t, colours.named.text);
    this.paintDots(context, t, colours);
  }

  /** The place of a value on the canvas; null for a value without a logarithm on a logarithmic axis. */
  private readonly place: Place = (t, value) => {
    if (!Number.isFinite(value) || (this.onLog && value === 0)) return null;
    return this.axes!.place(t, this.onLog ? Math.log10(Math.abs(value)) : value);
  };

  private paintCurve(context: CanvasRenderingContext2D, curve: Curve, colours: Colours): void {
    const scaled: Place = (t, value) => this.place(t, this.factor * value);
    context.strokeStyle = colourOf(curve.number, colours);
    context.setLineDash(curve.stored ? STORED.dash : dashOf(curve.number));
    context.lineWidth = curve.stored ? STORED.width : WIDTH;
    context.stroke(lineOf(curve, [this.span.from, this.span.to], this.width, scaled));
    context.setLineDash([]);
  }

  private paintLine(context: CanvasRenderingContext2D, t: number, colour: string): void {
    context.strokeStyle = colour;
    context.lineWidth = 1.2;
    this.axes!.line(context, t);
  }

  /** The curves whose time range contains t. */
  private at(t: number): Curve[] {
    return this.curves.filter(({ t: own }) => own[0]! <= t && t <= own[own.length - 1]!);
  }

  private paintDots(context: CanvasRenderingContext2D, t: number, colours: Colours): void {
    for (const curve of this.at(t)) {
      const place = this.place(t, this.shown(curve, t));
      if (!place) continue;
      const dot = circle(place, curve.stored ? 3 : 4);
      context.fillStyle = colourOf(curve.number, colours);
      context.fill(dot);
      context.strokeStyle = colours.named.panel;
      context.stroke(dot);
    }
  }

  /** The curve nearest to the pointer at t. */
  private nearest(t: number, [, y]: Point): Curve | null {
    const away = (curve: Curve) => {
      const place = this.place(t, this.shown(curve, t));
      return place ? Math.abs(place[1] - y) : Number.POSITIVE_INFINITY;
    };
    const [first, ...others] = this.at(t);
    return first ? others.reduce((best, curve) => (away(curve) < away(best) ? curve : best), first) : null;
  }

  /** Name and value of the curve nearest to the pointer, as text beside the line. */
  private paintReading(context: CanvasRenderingContext2D, t: number, pointer: Point, colours: Colours): string {
    const curve = this.nearest(t, pointer);
    if (!curve) return "";
    const text = `${curve.name} = ${this.write(curve, t)}`;
    context.font = font(12, 600);
    context.textBaseline = "top";
    context.textAlign = "left";
    const x = this.axes!.place(t, this.range[0])[0] + 8;
    const width = context.measureText(text).width;
    const at: Point = [Math.max(4, Math.min(x, this.width - width - 6)), 24];
    rimmed(context, text, at, colours.named.text, colours.named.panel);
    return text;
  }
}
