// Measures in a drawing: grid, scale of length, gravity.
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { paintArrow } from "./arrow";
import { Line } from "./line";
import type { Box } from "./paint";
import { type Colours, font, rimmed } from "./surface";
import { roundBelow } from "./ticks";

/** The step of the grid, m. */
export function gridStep(view: View): number {
  return roundBelow(110 / view.scale);
}

/** A faint grid with round steps; while drawing, also a fainter one with a fifth or a tenth of the step. */
export function paintGrid(context: CanvasRenderingContext2D, view: View, colours: Colours, fine: boolean): void {
  const step = gridStep(view);
  if (fine) {
    context.globalAlpha = 0.55;
    paintLines(context, view, snapStep(view), colours.named.grid);
    context.globalAlpha = 1;
  }
  paintLines(context, view, step, fine ? colours.named.edge : colours.named.grid, fine ? 0.5 : 1);
}

/** Points snap to multiples of this step, a tenth of the step of the grid. */
export function snapStep(view: View): number {
  return gridStep(view) / 10;
}

function paintLines(context: CanvasRenderingContext2D, view: View, step: number, colour: string, alpha = 1): void {
  const [x0, y1] = view.toPlane([0, 0]);
  const [x1, y0] = view.toPlane([view.width, view.height]);
  let lines = "";
  for (let k = Math.ceil(x0 / step); k * step <= x1; k += 1) {
    const x = Math.round(view.toScreen([k * step, 0])[0]) + 0.5;
    lines += `M${x} 0V${view.height}`;
  }
  for (let k = Math.ceil(y0 / step); k * step <= y1; k += 1) {
    const y = Math.round(view.toScreen([0, k * step])[1]) + 0.5;
    lines += `M0 ${y}H${view.width}`;
  }
  context.save();
  context.globalAlpha *= alpha;
  context.strokeStyle = colour;
  context.lineWidth = 1;
  context.stroke(new Line(lines));
  context.restore();
}

/** The scale: a line as long as a step of the grid, with its length as text. */
export function paintLengthScale(
  context: CanvasRenderingContext2D,
  view: View,
  { unit, metres }: { unit: string; metres: number },
  colours: Colours,
): void {
  const step = gridStep(view);
  const length = step * view.scale;
  const [x, y] = [16, view.height - 16];
  context.strokeStyle = colours.named.soft;
  context.lineWidth = 1.5;
  context.stroke(new Line(`M${x} ${y - 5}v5h${length}v-5`));
  context.font = font(12);
  context.textAlign = "center";
  context.textBaseline = "alphabetic";
  const text = `${Number((step / metres).toPrecision(3))} ${unit}`;
  rimmed(context, text, [x + length / 2, y - 6], colours.named.soft, colours.named.panel);
}

/** Lines of text in the upper left corner; returns their boxes. */
export function paintNotes(context: CanvasRenderingContext2D, notes: readonly string[], colours: Colours): Box[] {
  context.font = font(12);
  context.textAlign = "left";
  context.textBaseline = "middle";
  return notes.map((note, k) => {
    const [x, y] = [16, 18 + 18 * k];
    rimmed(context, note, [x, y], colours.named.soft, colours.named.panel);
    return [x, y - 8, x + context.measureText(note).width, y + 8];
  });
}

/** The arrow of gravity. */
export function paintGravity(context: CanvasRenderingContext2D, view: View, gravity: Point, colours: Colours): void {
  const size = Math.hypot(...gravity);
  if (!(size > 0)) return;
  const [dx, dy] = [gravity[0] / size, -gravity[1] / size];
  const [x, y] = [view.width - 30, 32];
  paintArrow(context, [x - 13 * dx, y - 13 * dy], [x + 13 * dx, y + 13 * dy], colours.named.soft, 1.6);
  context.font = `italic ${font(14)}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = colours.named.soft;
  context.fillText("g", x - 12 * Math.abs(dy) - 0.1, y - 14 * Math.abs(dx));
}
