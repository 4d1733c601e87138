// A plot over time with a cursor at the present.
import { scaled, ticks } from "./numbers.js";
import { cleared, font, sharpen } from "./surface.js";

const ROOM = { left: 58, right: 16, top: 26, bottom: 40 };

/** Plots channels of a scene on a canvas; all of them share a unit. */
export class Plot {
  constructor(canvas, motion) {
    this.canvas = canvas;
    this.motion = motion;
    this.curves = [];
    this.showAll();
    this.resize();
  }

  /** Show these curves: `{channel, colour(colours)}`. */
  show(curves) {
    this.curves = curves;
    const values = curves.flatMap(({ channel }) => channel.values.filter((value) => value !== null));
    const low = values.reduce((least, value) => Math.min(least, value), Infinity);
    const high = values.reduce((most, value) => Math.max(most, value), -Infinity);
    const largest = Number.isFinite(low) ? Math.max(Math.abs(low), Math.abs(high)) : 0;
    const { factor, unit } = scaled(largest, curves[0]?.channel.unit ?? "");
    Object.assign(this, { factor, unit, range: widened(low / factor, high / factor) });
  }

  resize() {
    sharpen(this.canvas);
    const { width, height } = this.canvas.getBoundingClientRect();
    Object.assign(this, { width, height });
  }

  /** Show all times. */
  showAll() {
    this.window = [this.motion.begin, this.motion.end];
  }

  /** Show `factor` times as much time, with that under a place (px) staying there. */
  stretch(factor, px) {
    const { begin, end } = this.motion;
    const at = this.timeAt(px);
    const [from, to] = this.window.map((t) => at + (t - at) * factor);
    if (to - from < 1e-6 * (end - begin)) return;
    this.window = [Math.max(begin, from), Math.min(end, to)];
  }

  /** Move the window so that it holds t. */
  follow(t) {
    const [from, to] = this.window;
    if (t >= from && t <= to) return;
    const length = to - from;
    const start = Math.min(Math.max(t - 0.1 * length, this.motion.begin), this.motion.end - length);
    this.window = [start, start + length];
  }

  /** The time under a place on the canvas, px from its left edge. */
  timeAt(px) {
    const [begin, end] = this.window;
    const share = (px - ROOM.left) / Math.max(1, this.width - ROOM.left - ROOM.right);
    return begin + Math.min(1, Math.max(0, share)) * (end - begin);
  }

  toScreen(t, value) {
    const [begin, end] = this.window;
    const [low, high] = this.range;
    const share = end > begin ? (t - begin) / (end - begin) : 0;
    const x = ROOM.left + share * (this.width - ROOM.left - ROOM.right);
    const rise = (value - low) / (high - low);
    return [x, this.height - ROOM.bottom - rise * (this.height - ROOM.top - ROOM.bottom)];
  }

  /** Draw with the cursor at t. */
  paint(t, colours) {
    const context = cleared(this.canvas);
    if (!this.curves.length) return;
    this.follow(t);
    this.paintAxes(context, colours);
    context.save();
    context.beginPath();
    context.rect(ROOM.left - 2, 0, this.width - ROOM.left - ROOM.right + 4, this.height);
    context.clip();
    for (const { channel, colour } of this.curves) this.paintCurve(context, channel, colour(colours));
    context.restore();
    this.paintCursor(context, t, colours);
  }

  paintAxes(context, colours) {
    const { width, height, range } = this;
    const across = ticks(...this.window, Math.max(2, Math.floor(width / 90)));
    const up = ticks(...range, Math.max(2, Math.floor(height / 60)));
    context.strokeStyle = colours.grid;
    context.fillStyle = colours.soft;
    context.lineWidth = 1;
    context.font = font(12);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of up.values) {
      const y = Math.round(this.toScreen(0, value)[1]) + 0.5;
      context.stroke(new Path2D(`M${ROOM.left} ${y}H${width - ROOM.right}`));
      context.fillText(up.write(value), ROOM.left - 8, y);
    }
    context.strokeStyle = colours.edge;
    context.textAlign = "center";
    context.textBaseline = "top";
    context.stroke(new Path2D(`M${ROOM.left} ${height - ROOM.bottom + 0.5}H${width - ROOM.right}`));
    for (const value of across.values) {
      const x = Math.round(this.toScreen(value, 0)[0]) + 0.5;
      context.stroke(new Path2D(`M${x} ${height - ROOM.bottom}v5`));
      context.fillText(across.write(value), x, height - ROOM.bottom + 8);
    }
    context.fillStyle = colours.text;
    context.fillText("t / s", (ROOM.left + width - ROOM.right) / 2, height - 16);
    context.textAlign = "left";
    context.fillText(this.unit, 12, 7);
  }

  paintCurve(context, channel, colour) {
    const path = new Path2D();
    let broken = true;
    channel.values.forEach((value, k) => {
      if (value === null) {
        broken = true;
        return;
      }
      const place = this.toScreen(this.motion.t[k], value / this.factor);
      if (broken) path.moveTo(...place);
      path.lineTo(...place);
      broken = false;
    });
    context.strokeStyle = colour;
    context.lineWidth = 1.8;
    context.stroke(path);
  }

  paintCursor(context, t, colours) {
    const x = this.toScreen(t, 0)[0];
    context.strokeStyle = colours.text;
    context.lineWidth = 1.2;
    context.stroke(new Path2D(`M${x} ${ROOM.top - 6}V${this.height - ROOM.bottom}`));
    for (const { channel, colour } of this.curves) {
      const value = this.motion.value(channel, t) / this.factor;
      if (!Number.isFinite(value)) continue;
      const dot = new Path2D();
      dot.arc(...this.toScreen(t, value), 4.5, 0, 2 * Math.PI);
      context.fillStyle = colour(colours);
      context.fill(dot);
      context.strokeStyle = colours.panel;
      context.stroke(dot);
    }
  }
}

/** A range with some room above and below. */
function widened(low, high) {
  if (!(high >= low)) return [0, 1];
  const room = 0.06 * (high - low) || 0.5 * Math.abs(high) || 1;
  return [low === 0 ? 0 : low - room, high + room];
}
