// One arrow.
import type { Point } from "../plane/points";
import { Line } from "./line";

/** A straight arrow with a solid head, with a rim of another colour if one is given. */
export function paintArrow(
  context: CanvasRenderingContext2D,
  [x0, y0]: Point,
  [x1, y1]: Point,
  colour: string,
  width: number,
  rim: string | null = null,
): void {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (!(length > 0)) return;
  const head = Math.min(4 + 2.4 * width, 0.6 * length);
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const [bx, by] = [x1 - head * ux, y1 - head * uy];
  const wing = 0.42 * head;
  const shaft = new Line(`M${x0} ${y0}L${bx} ${by}`);
  const tip = new Line(`M${x1} ${y1}L${bx - wing * uy} ${by + wing * ux}L${bx + wing * uy} ${by - wing * ux}z`);
  if (rim) {
    context.strokeStyle = rim;
    context.lineWidth = width + 3;
    context.stroke(shaft);
    context.lineWidth = 3;
    context.stroke(tip);
  }
  context.strokeStyle = colour;
  context.fillStyle = colour;
  context.lineWidth = width;
  context.stroke(shaft);
  context.fill(tip);
}

/** Two strokes across an arrow that is drawn shorter than its value. */
export function paintBreak(
  context: CanvasRenderingContext2D,
  [x0, y0]: Point,
  [x1, y1]: Point,
  colour: string,
  background: string,
): void {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 24) return;
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const [mx, my] = [x0 + 0.45 * (x1 - x0), y0 + 0.45 * (y1 - y0)];
  const [sx, sy] = [5 * (uy - 0.4 * ux), 5 * (ux + 0.4 * uy)];
  const stroke = (at: number) => `M${mx + at * ux - sx} ${my + at * uy + sy}l${2 * sx} ${-2 * sy}`;
  const strokes = new Line(stroke(-2.5) + stroke(2.5));
  context.strokeStyle = background;
  context.lineWidth = 6;
  context.stroke(strokes);
  context.strokeStyle = colour;
  context.lineWidth = 1.6;
  context.stroke(strokes);
}
