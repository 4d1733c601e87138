// The places of the items of the display list at one instant, by the rules of kempe/draw/placing.py.
import { type Placement, type Point, placed } from "../plane/points";
import type { View } from "../plane/view";
import type { Frame, Item } from "./items";

/** Pixels for each point of print. */
export const UNIT = 1.5;
const SPACING = 4;
const STROKE = 5;

type Rows = Item["points"];
export type BodyFrame = Extract<Frame, { type: "body" }>;
type Local = { origin: Point; angle: number; local: Point[] };

/** The local places of rows that move with a body, px. They depend on the scale only. */
export function rigidPoints(rows: Rows, scale: number, unit: number): Point[] {
  return rows.map(([x, y, px, py]): Point => [x * scale + px * unit, y * scale + py * unit]);
}

/** The origin of the frame of a body on the canvas, px, and its angle, counter-clockwise. */
export function rigidFrame(
  frame: BodyFrame,
  poses: readonly Placement[],
  view: View,
): { origin: Point; angle: number } {
  const origin = view.toScreen(placed(poses[frame.body]!, frame.at));
  return { origin, angle: poses[frame.turns_with]![2] + frame.turn };
}

/** Origin, angle and local places (px) of rows in the frame of an item; a point of print has `unit` px. */
function inFrameOf(frame: Frame, rows: Rows, poses: readonly Placement[], view: View, unit: number): Local {
  const at = (body: number, point: Point) => view.toScreen(placed(poses[body]!, point));
  if (frame.type === "body") return { ...rigidFrame(frame, poses, view), local: rigidPoints(rows, view.scale, unit) };
  const [i, j] = frame.bodies;
  if (frame.type === "twist") {
    const turn = frame.turn + poses[j]![2] - poses[i]![2];
    const local = rows.map(([x, , radius]): Point => {
      const angle = poses[i]![2] + x * turn;
      return [radius * unit * Math.cos(angle), radius * unit * Math.sin(angle)];
    });
    return { origin: at(j, frame.at), angle: 0, local };
  }
  const [begin, end] = [at(i, frame.ends[0]), at(j, frame.ends[1])];
  const [dx, dy] = [end[0] - begin[0], begin[1] - end[1]];
  const length = Math.hypot(dx, dy);
  const squeezed = frame.room ? Math.min(1, length / (frame.room * unit)) : 1;
  const along = frame.type === "line" ? length : view.scale;
  const local = rows.map(([x, y, px, py]): Point => [x * along + px * squeezed * unit, y * view.scale + py * unit]);
  return { origin: begin, angle: Math.atan2(dy, dx), local };
}

/** The points of an item on the canvas, px; `angle` is that of its frame, counter-clockwise. */
export function placeItem(
  item: Item,
  poses: readonly Placement[],
  view: View,
  unit: number,
): { points: Point[]; angle: number } {
  const { origin, angle, local } = inFrameOf(item.frame, item.points, poses, view, unit);
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  const points = local.map(([x, y]): Point => [origin[0] + cos * x - sin * y, origin[1] - sin * x - cos * y]);
  return { points, angle };
}

/** Whether all bodies that an item follows have a pose. */
export function isPlaceable({ frame }: Item, poses: readonly Placement[]): boolean {
  return frame.type === "body"
    ? frame.body < poses.length && frame.turns_with < poses.length
    : frame.bodies.every((body) => body < poses.length);
}

/** Strokes of ground on one side of a line, as a path. */
export function hatching(points: Point[], side: number, unit: number): string {
  let strokes = "";
  let left = 0.75 * SPACING * unit; // the distance to the next stroke
  for (let k = 1; k < points.length; k += 1) {
    const [[x0, y0], [x1, y1]] = [points[k - 1]!, points[k]!];
    const length = Math.hypot(x1 - x0, y1 - y0) || 1;
    const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
    const reach = (STROKE * unit) / Math.SQRT2;
    const [dx, dy] = [reach * (side * uy - ux), reach * (-side * ux - uy)];
    for (; left < length; left += SPACING * unit) strokes += `M${x0 + left * ux} ${y0 + left * uy}l${dx} ${dy}`;
    left -= length;
  }
  return strokes;
}
