// The arrows of a drawing. They stay in view, and their texts name owner and magnitude.
import { distance, type Point } from "../plane/points";
import type { View } from "../plane/view";
import { paintArrow, paintBreak } from "./arrow";
import { quantity, roundQuantity } from "./numbers";
import type { Box } from "./paint";
import { type Colours, font, rimmed } from "./surface";
import { roundBelow } from "./ticks";

export const ARROW_KINDS = ["reactions", "force", "velocities", "accelerations"] as const;
export type ArrowKind = (typeof ARROW_KINDS)[number];

export interface Vector {
  element: string;
  /** The name in the text, before the magnitude. */
  owner: string;
  /** Its start in the plane, m. */
  at: Point;
  value: Point;
}

/** The vectors of one kind at one instant, and the length of one unit of them, px. */
export interface Vectors {
  kind: ArrowKind;
  unit: string;
  pixels: number;
  /** Whether their scale is painted, too; it is if this is not given. */
  scaled?: boolean;
  vectors: Vector[];
}

/** An arrow on the canvas, px. */
export interface Arrow {
  kind: Vectors["kind"];
  element: string;
  from: Point;
  to: Point;
  /** Whether all of it is in view. */
  whole: boolean;
  text: string;
  /** The position of the text. */
  box?: Box;
}

const INSET = 6;
const TEXT = 12;
/** With more arrows than this, texts that would cover others are left out. */
const MOST_COVERED = 12;
/** The size of the boxes along an arrow, px. */
const SHAFT = 6;
/** Directions from an arrow to its text, relative to the direction of the arrow. */
const TURNS = [0, 0.8, -0.8, 1.57, -1.57, 2.4, -2.4, 3.14];

/** Paint the arrows of all kinds with their scales; `taken` are the boxes of the names. */
export function paintArrows(
  context: CanvasRenderingContext2D,
  view: View,
  kinds: readonly Vectors[],
  taken: Box[],
  colours: Colours,
): Arrow[] {
  let right = view.width - 16;
  const arrows: Arrow[] = [];
  for (const vectors of kinds) {
    const found = arrowsOf(vectors, view);
    for (const { kind, from, to, whole } of found) {
      paintArrow(context, from, to, colours.named[kind], 2.4, colours.named.panel);
      if (!whole) paintBreak(context, from, to, colours.named[kind], colours.named.panel);
    }
    if (vectors.scaled !== false) right = paintScale(context, view, vectors, right, colours);
    arrows.push(...found);
  }
  paintTexts(context, arrows, view, colours, taken);
  return arrows;
}

function arrowsOf({ kind, unit, pixels, vectors }: Vectors, view: View): Arrow[] {
  return vectors.flatMap(({ element, owner, at, value }) => {
    const from = view.toScreen(at);
    const size = Math.hypot(...value);
    if (!(size * pixels > 1) || !from.every(Number.isFinite)) return [];
    const part = clipped(from, [from[0] + value[0] * pixels, from[1] - value[1] * pixels], view);
    return part ? [{ kind, element, from, ...part, text: `${quantity(size, unit)} ${owner}` }] : [];
  });
}

/** The part of an arrow that lies in the view; null if it begins outside of it. */
function clipped([x0, y0]: Point, [x1, y1]: Point, { width, height }: View): { to: Point; whole: boolean } | null {
  if (!(x0 >= 0 && x0 <= width && y0 >= 0 && y0 <= height)) return null;
  const share = (from: number, to: number, least: number, most: number) => {
    if (to > most) return Math.max(0, (most - from) / (to - from));
    return to < least ? Math.max(0, (least - from) / (to - from)) : 1;
  };
  const part = Math.min(share(x0, x1, INSET, width - INSET), share(y0, y1, INSET, height - INSET));
  return { to: [x0 + part * (x1 - x0), y0 + part * (y1 - y0)], whole: part === 1 };
}

/** Write the text of each arrow where it covers least of the taken boxes, and add its own box to them. */
function paintTexts(
  context: CanvasRenderingContext2D,
  arrows: Arrow[],
  view: View,
  colours: Colours,
  taken: Box[],
): void {
  context.font = font(TEXT);
  context.textAlign = "left";
  context.textBaseline = "middle";
  // If there are few arrows, texts avoid the arrows too.
  const shafts = arrows.length > MOST_COVERED ? [] : arrows.flatMap(shaftOf);
  for (const arrow of arrows) {
    const { box, covered } = freePlace(context.measureText(arrow.text).width, arrow, view, taken, shafts);
    if (covered && arrows.length > MOST_COVERED) continue;
    taken.push(box);
    arrow.box = box;
    rimmed(context, arrow.text, [box[0], (box[1] + box[3]) / 2], colours.named[arrow.kind], colours.named.panel);
  }
}

/** Small boxes along an arrow. */
function shaftOf({ from, to }: Arrow): Box[] {
  const count = Math.ceil(distance(from, to) / SHAFT);
  return Array.from({ length: count + 1 }, (_, k) => {
    const [x, y] = [0, 1].map((axis) => from[axis]! + (k / count) * (to[axis]! - from[axis]!)) as Point;
    return [x - SHAFT / 2, y - SHAFT / 2, x + SHAFT / 2, y + SHAFT / 2];
  });
}

/** The box near an arrow that covers least of the taken boxes; among equal ones, least of the arrows. */
function freePlace(
  width: number,
  { from, to }: Arrow,
  view: View,
  taken: readonly Box[],
  shafts: readonly Box[],
): { box: Box; covered: number } {
  const high = TEXT + 4;
  const heading = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const middle: Point = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
  const over = (box: Box, others: readonly Box[]) => others.reduce((sum, other) => sum + common(box, other), 0);
  let best: { box: Box; covered: number; hidden: number } | null = null;
  for (const gap of [5, 22]) {
    for (const anchor of [to, middle]) {
      for (const turn of TURNS) {
        const [dx, dy] = [Math.cos(heading + turn), Math.sin(heading + turn)];
        const cx = within(anchor[0] + dx * (width / 2 + gap), width / 2 + 4, view.width);
        const cy = within(anchor[1] + dy * (high / 2 + gap), high / 2 + 2, view.height);
        const box: Box = [cx - width / 2, cy - high / 2, cx + width / 2, cy + high / 2];
        const covered = over(box, taken);
        const hidden = covered + over(box, shafts);
        if (!hidden) return { box, covered };
        if (!best || hidden < best.hidden) best = { box, covered, hidden };
      }
    }
  }
  return best!;
}

function within(at: number, half: number, size: number): number {
  return Math.max(half, Math.min(size - half, at));
}

/** The area that two boxes have in common. */
function common(a: Box, b: Box): number {
  const wide = Math.min(a[2], b[2]) - Math.max(a[0], b[0]);
  const high = Math.min(a[3], b[3]) - Math.max(a[1], b[1]);
  return wide > 0 && high > 0 ? wide * high : 0;
}

/** Paint the scale of a kind: a round value and its length. Returns the place to the left of it, px. */
export function paintScale(
  context: CanvasRenderingContext2D,
  view: Pick<View, "width" | "height">,
  { kind, unit, pixels }: Pick<Vectors, "kind" | "unit" | "pixels">,
  right: number,
  colours: Colours,
): number {
  if (!(pixels > 0)) return right;
  const value = roundBelow(Math.min(110, 0.16 * view.width) / pixels);
  const y = view.height - 16;
  const text = roundQuantity(value, unit);
  context.font = font(TEXT);
  context.textAlign = "right";
  context.textBaseline = "alphabetic";
  paintArrow(context, [right - value * pixels, y], [right, y], colours.named[kind], 2.4);
  rimmed(context, text, [right, y - 9], colours.named.text, colours.named.panel);
  return right - Math.max(value * pixels, context.measureText(text).width) - 16;
}
