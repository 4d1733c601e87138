// Measures in a drawing: grid, scale of length, gravity.
import { paintArrow } from "./arrow.js";
import { roundBelow } from "./numbers.js";
import { font, rimmed } from "./surface.js";

/** A faint grid with round steps. */
export function paintGrid(context, view, colours) {
  const step = roundBelow(110 / view.scale);
  const [x0, y1] = view.toPlane([0, 0]);
  const [x1, y0] = view.toPlane([view.width, view.height]);
  const lines = new Path2D();
  for (let k = Math.ceil(x0 / step); k * step <= x1; k += 1) {
    const x = Math.round(view.toScreen([k * step, 0])[0]) + 0.5;
    lines.moveTo(x, 0);
    lines.lineTo(x, view.height);
  }
  for (let k = Math.ceil(y0 / step); k * step <= y1; k += 1) {
    const y = Math.round(view.toScreen([0, k * step])[1]) + 0.5;
    lines.moveTo(0, y);
    lines.lineTo(view.width, y);
  }
  context.strokeStyle = colours.grid;
  context.lineWidth = 1;
  context.stroke(lines);
  return step;
}

/** How long a step of the grid is. */
export function paintLengthScale(context, view, step, { unit, metres }, colours) {
  const length = step * view.scale;
  const [x, y] = [16, view.height - 16];
  context.strokeStyle = colours.soft;
  context.lineWidth = 1.5;
  context.stroke(new Path2D(`M${x} ${y - 5}v5h${length}v-5`));
  context.font = font(12);
  context.textAlign = "center";
  context.textBaseline = "alphabetic";
  rimmed(context, `${Number((step / metres).toPrecision(3))} ${unit}`, [x + length / 2, y - 6], colours.soft, colours.panel);
}

/** Which way things fall. */
export function paintGravity(context, view, gravity, colours) {
  const size = Math.hypot(...gravity);
  if (!(size > 0)) return;
  const [dx, dy] = [gravity[0] / size, -gravity[1] / size];
  const [x, y] = [view.width - 30, 32];
  const from = [x - 13 * dx, y - 13 * dy];
  paintArrow(context, from, [x + 13 * dx, y + 13 * dy], colours.soft, 1.6);
  context.font = `italic ${font(14)}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = colours.soft;
  context.fillText("g", x - 12 * Math.abs(dy) - 0.1, y - 14 * Math.abs(dx));
}
