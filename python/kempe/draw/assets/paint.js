// Paints the display list: lines, fills and texts, whatever they are of.
import { hatching, placeItem } from "./place.js";
import { shortened } from "./numbers.js";
import { font, rimmed } from "./surface.js";

/** Pixels for each point of print. */
const UNIT = 1.5;
const HATCH_WIDTH = 0.7;
/** Which box shows or hides a text. */
const SWITCH = { number: "numbers" };

/** The paths of the traced points. */
export function paintPaths(context, view, traces, colours) {
  context.globalAlpha = 0.55;
  context.lineWidth = 1.5;
  for (const { path, body } of traces) {
    const seen = new Path2D();
    seen.addPath(path, view.matrix());
    context.strokeStyle = colours.body(body);
    context.stroke(seen);
  }
  context.globalAlpha = 1;
}

/** Everything in the display list that is shown; returns the boxes of the texts. */
export function paintItems(context, view, items, poses, shown, colours) {
  const boxes = [];
  for (const item of items) {
    if (!isShown(item, shown)) continue;
    const { points, angle } = placeItem(item, poses, view, UNIT);
    if (!points.every(([x, y]) => Number.isFinite(x + y))) continue;
    const colour = tinted(colours, item);
    if (item.kind === "text") boxes.push(paintText(context, view, item, points[0], angle, colours));
    else if (item.kind === "fill") paintFill(context, points, colour);
    else paintLine(context, item, points, colour);
  }
  return boxes;
}

/** Names and numbers can be switched off; the circle of a number goes with it. */
function isShown({ kind, role, numbered }, shown) {
  if (numbered) return shown.numbers;
  return kind !== "text" || shown[SWITCH[role] ?? "names"];
}

/** The colour of an item: that of its role, mixed with the colour of the sheet. */
function tinted(colours, { colour, tint }) {
  const [role, number] = colour.split(" ");
  const full = role === "body" ? colours.body(Number(number)) : colours[role];
  return tint ? `color-mix(in srgb, ${colours.panel} ${100 * tint}%, ${full})` : full;
}

function outline(points, closed) {
  const shape = new Path2D();
  for (const [x, y] of points) shape.lineTo(x, y);
  if (closed) shape.closePath();
  return shape;
}

function paintFill(context, points, colour) {
  context.fillStyle = colour;
  context.fill(outline(points, true));
}

function paintLine(context, { width, closed, hatch }, points, colour) {
  context.strokeStyle = colour;
  context.lineWidth = width * UNIT;
  context.stroke(outline(points, closed));
  if (!hatch) return;
  context.lineWidth = HATCH_WIDTH * UNIT;
  context.stroke(new Path2D(hatching(points, hatch, UNIT)));
}

function paintText(context, view, item, [x, y], angle, colours) {
  context.save();
  const slant = item.slanted ? "italic " : "";
  context.font = slant + font(item.size * UNIT, item.weight === "bold" ? 600 : 400);
  context.textAlign = "center";
  context.textBaseline = "middle";
  const text = shortened(item.text);
  const place = [x + item.offset[0] * UNIT, y - item.offset[1] * UNIT];
  const [cx, cy] = item.turned ? place : inside(context, text, place, view);
  context.translate(cx, cy);
  if (item.turned) context.rotate(-readable(angle));
  rimmed(context, text, [0, 0], tinted(colours, item), colours.panel);
  const [wide, high] = [context.measureText(text).width / 2, 0.6 * item.size * UNIT];
  context.restore();
  return [cx - wide, cy - high, cx + wide, cy + high];
}

/** The same direction of a line of text, read from the left or from below. */
function readable(angle) {
  return angle - Math.PI * Math.ceil(angle / Math.PI - 0.5 - 1e-8);
}

/** A place for a text, moved sideways so that all of it is seen if its anchor is. */
function inside(context, text, [x, y], { width }) {
  if (x < 0 || x > width) return [x, y];
  const half = context.measureText(text).width / 2 + 6;
  return [Math.max(half, Math.min(width - half, x)), y];
}
