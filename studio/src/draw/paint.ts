// Paints the display list: lines, fills and texts, whatever they are of.
import type { Placement, Point } from "../plane/points";
import type { View } from "../plane/view";
import type { Item } from "./items";
import { Line, through } from "./line";
import { shortened } from "./numbers";
import { hatching, isPlaceable, placeItem, UNIT } from "./place";
import { type ColourName, type Colours, font, rimmed } from "./surface";

const HATCH_WIDTH = 0.7;

export interface Shown {
  names: boolean;
  numbers: boolean;
}

/** Left, top, right and bottom, px. */
export type Box = [number, number, number, number];

/** Everything in the display list that is shown; returns the boxes of the texts. */
export function paintItems(
  context: CanvasRenderingContext2D,
  view: View,
  items: readonly Item[],
  poses: readonly Placement[],
  shown: Shown,
  colours: Colours,
): Box[] {
  const boxes: Box[] = [];
  for (const item of items) {
    if (!isShown(item, shown) || !isPlaceable(item, poses)) continue;
    const { points, angle } = placeItem(item, poses, view, UNIT);
    if (!points.every(([x, y]) => Number.isFinite(x + y))) continue;
    const colour = tinted(colours, item);
    if (item.kind === "text") boxes.push(paintText(context, view, item, points[0]!, angle, colours));
    else if (item.kind === "fill") paintFill(context, points, colour);
    else paintLine(context, item, points, colour);
  }
  return boxes;
}

/** Names and numbers can be switched off; the circle of a number goes with it. */
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

function paintFill(context: CanvasRenderingContext2D, points: Point[], colour: string): void {
  context.fillStyle = colour;
  context.fill(through(points, true));
}

function paintLine(
  context: CanvasRenderingContext2D,
  item: Item & { kind: "line" },
  points: Point[],
  colour: string,
): void {
  context.strokeStyle = colour;
  context.lineWidth = item.width * UNIT;
  context.stroke(through(points, item.closed));
  if (!item.hatch) return;
  context.lineWidth = HATCH_WIDTH * UNIT;
  context.stroke(new Line(hatching(points, item.hatch, UNIT)));
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

/** The same direction of a line of text, read from the left or from below. */
function readableAngle(angle: number): number {
  return angle - Math.PI * Math.ceil(angle / Math.PI - 0.5 - 1e-8);
}

/** A place for a text, moved sideways so that all of it is seen if its anchor is. */
function inside(context: CanvasRenderingContext2D, text: string, [x, y]: Point, { width }: View): Point {
  if (x < 0 || x > width) return [x, y];
  const half = context.measureText(text).width / 2 + 6;
  return [Math.max(half, Math.min(width - half, x)), y];
}
