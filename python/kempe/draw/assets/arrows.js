// The arrows of a drawing: they stay in view and name their body and magnitude.
import { paintArrow, paintBreak } from "./arrow.js";
import { quantity, roundBelow, roundQuantity } from "./numbers.js";
import { font, rimmed } from "./surface.js";

const INSET = 6;
const TEXT = 12;
/** With more arrows than this, texts that would cover others are left out. */
const MOST_COVERED = 12;

/** The part of an arrow that lies in the view; null if it begins outside of it. */
export function clipped([x0, y0], [x1, y1], { width, height }) {
  const inside = (x, y) => x >= 0 && x <= width && y >= 0 && y <= height;
  if (!inside(x0, y0)) return null;
  const share = (from, to, least, most) => {
    if (to > most) return Math.max(0, (most - from) / (to - from));
    return to < least ? Math.max(0, (least - from) / (to - from)) : 1;
  };
  const part = Math.min(share(x0, x1, INSET, width - INSET), share(y0, y1, INSET, height - INSET));
  return { to: [x0 + part * (x1 - x0), y0 + part * (y1 - y0)], whole: part === 1 };
}

/** Arrows of one kind on the canvas, px: `{element, from, to, whole, text}`. */
export function arrowsOf(vectors, { name, unit }, places, view, pixels) {
  return vectors.flatMap(({ element, owner, value }, k) => {
    const from = places[k];
    const size = Math.hypot(...value);
    if (!(size * pixels > 1) || !from.every(Number.isFinite)) return [];
    const part = clipped(from, [from[0] + value[0] * pixels, from[1] - value[1] * pixels], view);
    return part ? [{ kind: name, element, from, ...part, text: `${quantity(size, unit)} ${owner}` }] : [];
  });
}

/** Paint arrows, then their texts where they cover least; adds the place of each text. */
export function paintArrows(context, arrows, view, colour, colours, taken) {
  for (const { from, to, whole } of arrows) {
    paintArrow(context, from, to, colours.panel, 5);
    paintArrow(context, from, to, colour, 2.4);
    if (!whole) paintBreak(context, from, to, colour, colours.panel);
  }
  context.font = font(TEXT);
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const arrow of arrows) {
    const { box, covered } = freePlace(context.measureText(arrow.text).width, arrow, view, taken);
    if (covered && arrows.length > MOST_COVERED) continue;
    taken.push(box);
    arrow.box = box;
    rimmed(context, arrow.text, [box[0], (box[1] + box[3]) / 2], colour, colours.panel);
  }
}

/** The box [left, top, right, bottom] beside the tip of an arrow that covers the least of those taken. */
function freePlace(width, { from, to }, view, taken) {
  const high = TEXT + 4;
  const length = Math.hypot(to[0] - from[0], to[1] - from[1]) || 1;
  const ahead = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
  const middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
  const places = [[to, ahead], [to, [-ahead[1], ahead[0]]], [to, [ahead[1], -ahead[0]]],
    [middle, [-ahead[1], ahead[0]]], [middle, [ahead[1], -ahead[0]]], [to, [0, -1]], [to, [0, 1]], [from, [-ahead[0], -ahead[1]]]];
  let best = null;
  for (const [[x, y], [dx, dy]] of places) {
    const cx = within(x + dx * (width / 2 + 8), width / 2 + 4, view.width);
    const cy = within(y + dy * (high / 2 + 5), high / 2 + 2, view.height);
    const box = [cx - width / 2, cy - high / 2, cx + width / 2, cy + high / 2];
    const covered = taken.reduce((sum, other) => sum + common(box, other), 0);
    if (!best || covered < best.covered) best = { box, covered };
    if (!covered) break;
  }
  return best;
}

function within(at, half, size) {
  return Math.max(half, Math.min(size - half, at));
}

/** The area that two boxes have in common. */
function common(a, b) {
  const [wide, high] = [0, 1].map((k) => Math.min(a[k + 2], b[k + 2]) - Math.max(a[k], b[k]));
  return wide > 0 && high > 0 ? wide * high : 0;
}

/** How long a round value is drawn; `row` counts the scales from below. */
export function paintArrowScale(context, view, { unit }, pixels, row, colour, colours) {
  if (!(pixels > 0)) return;
  const value = roundBelow(Math.min(110, 0.3 * view.width) / pixels);
  const [x, y] = [view.width - 16, view.height - 16 - 32 * row];
  paintArrow(context, [x - value * pixels, y], [x, y], colour, 2.4);
  context.font = font(TEXT);
  context.textAlign = "right";
  context.textBaseline = "alphabetic";
  rimmed(context, roundQuantity(value, unit), [x, y - 9], colours.text, colours.panel);
}
