// Paints the lines, areas and texts of the display list.
import type { Placement, Point } from "../plane/points";
import type { View } from "../plane/view";
import type { Item } from "./items";
import { Line, through } from "./line";
import { shortened } from "./numbers";
import { type BodyFrame, hatching, isPlaceable, placeItem, rigidFrame, rigidPoints, UNIT } from "./place";
import { type ColourName, type Colours, font, rimmed } from "./surface";

const HATCH_WIDTH = 0.7;

export interface Shown {
  names: boolean;
  numbers: boolean;
}

/** Left, top, right and bottom, px. */
export type Box = [number, number, number, number];

/** Paint the shown items of the display list; returns the boxes of the texts. */
export function paintItems(
  context: CanvasRenderingContext2D,
  view: View,
  items: readonly Item[],
  poses: readonly Placement[],
  shown: Shown,
  colours: Colours,
): Box[] {
  const boxes: Box[] = [];
  const frames = new Frames(context, poses, view);
  for (const item of items) {
    if (!isShown(item, shown) || !isPlaceable(item, poses)) continue;
    if (item.kind !== "text" && item.frame.type === "body") {
      if (frames.enter(item.frame)) paintRigid(context, item, view.scale, colours);
      continue;
    }
    frames.leave();
    const { points, angle } = placeItem(item, poses, view, UNIT);
    if (!points.every(([x, y]) => Number.isFinite(x + y))) continue;
    if (item.kind === "text") boxes.push(paintText(context, view, item, points[0]!, angle, colours));
    else paintShape(context, item, shapeOf(item, points), tinted(colours, item));
  }
  frames.leave();
  return boxes;
}

/** The frame in which a context paints. Consecutive items of one body share it. */
class Frames {
  private frame: BodyFrame | null = null;

  constructor(
    private readonly context: CanvasRenderingContext2D,
    private readonly poses: readonly Placement[],
    private readonly view: View,
  ) {}

  /** Enter the frame of an item; false if its body has no pose. */
  enter(frame: BodyFrame): boolean {
    if (this.frame && isSame(this.frame, frame)) return true;
    this.leave();
    const { origin, angle } = rigidFrame(frame, this.poses, this.view);
    if (!Number.isFinite(origin[0] + origin[1] + angle)) return false;
    this.context.save();
    this.context.translate(origin[0], origin[1]);
    this.context.rotate(-angle);
    this.frame = frame;
    return true;
  }

  /** Return to the frame of the canvas. */
  leave(): void {
    if (this.frame) this.context.restore();
    this.frame = null;
  }
}

function isSame(a: BodyFrame, b: BodyFrame): boolean {
  return (
    a.body === b.body &&
    a.turns_with === b.turns_with &&
    a.turn === b.turn &&
    a.at[0] === b.at[0] &&
    a.at[1] === b.at[1]
  );
}

/** Whether an item is shown. Names and numbers can be switched off, numbers with their circles. */
function isShown(item: Item, shown: Shown): boolean {
  if (item.numbered) return shown.numbers;
  if (item.kind !== "text") return true;
  return item.role === "number" ? shown.numbers : shown.names;
}

/** The colour of an item: that of its role, mixed with the colour of the sheet. */
function tinted(colours: Colours, { colour, tint }: Item): string {
  const [role, number] = colour.split(" ");
  const full = role === "body" ? colours.body(Number(number)) : colours.named[role as ColourName];
  return tint ? `color-mix(in srgb, ${colours.named.panel} ${100 * tint}%, ${full})` : full;
}

/** A line or an area, and the strokes of its hatching, px. */
interface Shape {
  path: Line;
  hatching: Line | null;
}

function shapeOf(item: Item, points: Point[]): Shape {
  const hatch = item.kind === "line" && item.hatch ? new Line(hatching(points, item.hatch, UNIT)) : null;
  return { path: through(points, item.kind === "fill" || (item.kind === "line" && item.closed)), hatching: hatch };
}

type Drawn = Item & { kind: "line" | "fill" };

/** The parts of an item that are kept between two pictures: its shape at a scale, and its colour. */
interface Kept {
  scale: number;
  shape: Shape;
  colours: Colours;
  colour: string;
}

const kept = new WeakMap<Item, Kept>();

/** Paint an item in the frame of its body. Its shape is made once for each scale. */
function paintRigid(context: CanvasRenderingContext2D, item: Drawn, scale: number, colours: Colours): void {
  let found = kept.get(item);
  if (found?.scale !== scale || found.colours !== colours) {
    // the y axis of the canvas points down
    const points = rigidPoints(item.points, scale, UNIT).map(([x, y]): Point => [x, -y]);
    found = { scale, shape: shapeOf(item, points), colours, colour: tinted(colours, item) };
    kept.set(item, found);
  }
  paintShape(context, item, found.shape, found.colour);
}

function paintShape(context: CanvasRenderingContext2D, item: Drawn, { path, hatching }: Shape, colour: string): void {
  if (item.kind === "fill") {
    context.fillStyle = colour;
    context.fill(path);
    return;
  }
  context.strokeStyle = colour;
  context.lineWidth = item.width * UNIT;
  context.stroke(path);
  if (!hatching) return;
  context.lineWidth = HATCH_WIDTH * UNIT;
  context.stroke(hatching);
}

function paintText(
  context: CanvasRenderingContext2D,
  view: View,
  item: Item & { kind: "text" },
  [x, y]: Point,
  angle: number,
  colours: Colours,
): Box {
  context.save();
  const slant = item.slanted ? "italic " : "";
  context.font = slant + font(item.size * UNIT, item.weight === "bold" ? 600 : 400);
  context.textAlign = "center";
  context.textBaseline = "middle";
  const text = shortened(item.text);
  const place: Point = [x + item.offset[0] * UNIT, y - item.offset[1] * UNIT];
  const [cx, cy] = item.turned ? place : inside(context, text, place, view);
  context.translate(cx, cy);
  if (item.turned) context.rotate(-readableAngle(angle));
  rimmed(context, text, [0, 0], tinted(colours, item), colours.named.panel);
  const [wide, high] = [context.measureText(text).width / 2, 0.6 * item.size * UNIT];
  context.restore();
  return [cx - wide, cy - high, cx + wide, cy + high];
}

/** The angle of a line of text, turned by 180° if necessary, so that it reads from the left or from below. */
function readableAngle(angle: number): number {
  return angle - Math.PI * Math.ceil(angle / Math.PI - 0.5 - 1e-8);
}

/** A place for a text. If its anchor is in view, it is moved sideways so that all of it is in view. */
function inside(context: CanvasRenderingContext2D, text: string, [x, y]: Point, { width }: View): Point {
  if (x < 0 || x > width) return [x, y];
  const half = context.measureText(text).width / 2 + 6;
  return [Math.max(half, Math.min(width - half, x)), y];
}
