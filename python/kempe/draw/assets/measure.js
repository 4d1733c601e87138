// Measures in a drawing: grid, scale of length, reaction arrows with their scale, gravity.
import { roundBelow, roundQuantity } from "./numbers.js";
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

/** The force of each joint on its body j, and an arrow of a length in proportion to it. */
export function paintReactions(context, view, pins, forces, pixelsPerNewton, colours) {
  const most = 3 * Math.hypot(view.width, view.height);
  forces.forEach(([fx, fy], k) => {
    const [x, y] = pins[k].at;
    const length = Math.hypot(fx, fy) * pixelsPerNewton;
    if (!(length > 1)) return;
    const shown = Math.min(1, most / length) * pixelsPerNewton;
    const to = [x + fx * shown, y - fy * shown];
    paintArrow(context, [x, y], to, colours.panel, 5);
    paintArrow(context, [x, y], to, colours.reaction, 2.4);
  });
  paintForceScale(context, view, pixelsPerNewton, colours);
}

function paintForceScale(context, view, pixelsPerNewton, colours) {
  const force = roundBelow(110 / pixelsPerNewton);
  const length = force * pixelsPerNewton;
  const [x, y] = [view.width - 20, view.height - 16];
  paintArrow(context, [x - length, y], [x, y], colours.reaction, 2.4);
  context.font = font(12);
  context.textAlign = "right";
  context.textBaseline = "alphabetic";
  rimmed(context, roundQuantity(force, "N"), [x, y - 9], colours.text, colours.panel);
}

function paintArrow(context, [x0, y0], [x1, y1], colour, width) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  const head = Math.min(4 + 2.4 * width, 0.6 * length);
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const [bx, by] = [x1 - head * ux, y1 - head * uy];
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = width;
  context.stroke(new Path2D(`M${x0} ${y0}L${bx} ${by}`));
  const wing = 0.42 * head;
  const tip = new Path2D(`M${x1} ${y1}L${bx - wing * uy} ${by + wing * ux}L${bx + wing * uy} ${by - wing * ux}z`);
  context.fill(tip);
  if (width > 4) context.stroke(tip);
}
