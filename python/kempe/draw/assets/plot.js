// A plot over time with a cursor at the present, and the values under the pointer.
import { Axes } from "./axes.js";
import { axisLabel, fixed, scaled, significant, withUnit } from "./numbers.js";
import { exponents, widened } from "./ranges.js";
import { cleared, colourOf, dashOf, font, rimmed, sharpen } from "./surface.js";

const DEGREES = 180 / Math.PI;

/** Plots curves of one unit on a canvas. */
export class Plot {
  constructor(canvas, motion, span) {
    Object.assign(this, { canvas, motion, span, curves: [], symbol: "", log: false, degrees: false, pointer: null, version: 0 });
    this.scale();
  }

  /** Show these curves. */
  show(curves, symbol) {
    Object.assign(this, { curves, symbol });
    this.scale();
  }

  /** Choose units and ranges for the curves. */
  scale() {
    const given = this.curves[0]?.unit ?? "";
    const turns = this.degrees && given.startsWith("rad");
    const factor = turns ? DEGREES : 1;
    const values = this.curves.map((curve) => curve.values.map((value) => factor * curve.shown(value)).filter(Number.isFinite));
    this.peaks = values.map((all) => all.reduce((most, value) => Math.max(most, Math.abs(value)), 0));
    const peak = Math.max(0, ...this.peaks);
    const unit = turns ? given.replace("rad", "°") : given;
    const written = this.log && peak > 0 ? { factor: 1, unit } : scaled(peak, unit);
    this.factor = factor / written.factor;
    this.peaks = this.peaks.map((one) => one / written.factor);
    this.unit = written.unit;
    this.onLog = this.log && peak > 0;
    this.version += 1;
    this.range = this.onLog ? exponents(values) : widened(values, written.factor);
    this.label = axisLabel(this.onLog && !this.symbol.startsWith("|") ? `|${this.symbol}|` : this.symbol, this.unit);
  }

  resize() {
    sharpen(this.canvas);
    const { width, height } = this.canvas.getBoundingClientRect();
    Object.assign(this, { width, height });
  }

  /** A value of a curve in the unit of the axis. */
  shown(curve, t) {
    return this.factor * curve.at(t);
  }

  /** A value as text with its unit: on a linear axis with the decimals of its curve. */
  write(curve, t) {
    const value = this.shown(curve, t);
    const text = this.onLog ? significant(value) : fixed(value, this.peaks[this.curves.indexOf(curve)]);
    return withUnit(text, this.unit);
  }

  /** Characters of the longest text of a curve. */
  widest(curve) {
    const peak = this.peaks[this.curves.indexOf(curve)];
    return withUnit(this.onLog ? significant(-peak) : fixed(-peak, peak), this.unit).length;
  }

  timeAt(px) {
    return this.axes ? this.axes.timeAt(px) : this.motion.begin;
  }

  /** Draw with the cursor at t and, if a time is looked at, a line there. */
  paint(t, looked, colours) {
    const context = cleared(this.canvas);
    if (!this.curves.length) return;
    context.drawImage(this.picture(colours), 0, 0, this.width, this.height);
    this.paintLine(context, t, colours.text);
    if (looked !== null) this.paintLine(context, looked, colours.accent);
    this.paintDots(context, looked ?? t, colours);
    this.reading = looked !== null && this.pointer ? this.paintReading(context, looked, colours) : "";
  }

  /** Axes and curves, painted anew only when they change. */
  picture(colours) {
    const key = JSON.stringify([this.width, this.height, this.canvas.width, this.span.from, this.span.to, this.version, colours.text]);
    if (key !== this.key) {
      this.kept = document.createElement("canvas");
      this.kept.width = this.canvas.width;
      this.kept.height = this.canvas.height;
      const context = this.kept.getContext("2d");
      context.scale(this.kept.width / this.width, this.kept.height / this.height);
      context.lineCap = context.lineJoin = "round";
      this.paintStill(context, colours);
      this.key = key;
    }
    return this.kept;
  }

  paintStill(context, colours) {
    this.axes = new Axes(context, this, this.span, { range: this.range, log: this.onLog, divisor: this.motion.variable.divisor });
    this.axes.paint(context, this.label, colours);
    context.save();
    this.axes.clip(context);
    for (const curve of this.curves) this.paintCurve(context, curve, colours);
    context.restore();
  }

  /** For a picture: axes, curves and the cursor at t. */
  paintAll(context, t, colours) {
    this.paintStill(context, colours);
    this.paintLine(context, t, colours.text);
    this.paintDots(context, t, colours);
  }

  /** The place of a value on the canvas; null where a logarithm has none. */
  place(t, value) {
    if (!Number.isFinite(value) || (this.onLog && value === 0)) return null;
    return this.axes.place(t, this.onLog ? Math.log10(Math.abs(value)) : value);
  }

  paintCurve(context, curve, colours) {
    const path = new Path2D();
    const { t } = this.motion;
    const [first, last] = [this.span.from, this.span.to].map((edge) => this.motion.place(edge));
    const apart = this.width / Math.max(1, last.high - first.low);
    const pieces = this.motion.smooth ? Math.min(16, Math.ceil(apart / 4)) : 1;
    let broken = true;
    const visit = (at, value) => {
      const place = this.place(at, value);
      if (place && broken) path.moveTo(...place);
      if (place) path.lineTo(...place);
      broken = !place;
    };
    for (let k = first.low; k <= last.high; k += 1) {
      visit(t[k], this.factor * curve.shown(curve.values[k]));
      for (let piece = 1; piece < pieces && k < last.high; piece += 1) {
        const at = t[k] + (piece / pieces) * (t[k + 1] - t[k]);
        visit(at, this.shown(curve, at));
      }
    }
    context.strokeStyle = colourOf(curve, colours);
    context.setLineDash(dashOf(curve));
    context.lineWidth = 1.8;
    context.stroke(path);
    context.setLineDash([]);
  }

  paintLine(context, t, colour) {
    context.strokeStyle = colour;
    context.lineWidth = 1.2;
    this.axes.line(context, t);
  }

  paintDots(context, t, colours) {
    for (const curve of this.curves) {
      const place = this.place(t, this.shown(curve, t));
      if (!place) continue;
      const dot = new Path2D();
      dot.arc(...place, 4, 0, 2 * Math.PI);
      context.fillStyle = colourOf(curve, colours);
      context.fill(dot);
      context.strokeStyle = colours.panel;
      context.stroke(dot);
    }
  }

  /** The curve nearest to the pointer at t. */
  nearest(t) {
    const away = (curve) => {
      const place = this.place(t, this.shown(curve, t));
      return place ? Math.abs(place[1] - this.pointer[1]) : Infinity;
    };
    return this.curves.reduce((best, curve) => (away(curve) < away(best) ? curve : best));
  }

  /** Time and value of the curve nearest to the pointer, as text beside the line. */
  paintReading(context, t, colours) {
    const curve = this.nearest(t);
    const text = `${curve.name} = ${this.write(curve, t)}`;
    context.font = font(12, 600);
    context.textBaseline = "top";
    context.textAlign = "left";
    const x = this.axes.place(t, this.range[0])[0] + 8;
    const width = context.measureText(text).width;
    rimmed(context, text, [Math.max(4, Math.min(x, this.width - width - 6)), 24], colours.text, colours.panel);
    return text;
  }
}
