// The arrows of a drawing: they stay in view and name their body and magnitude.
import { paintArrow, paintBreak } from "./arrow.js";
import { quantity, roundBelow, roundQuantity } from "./numbers.js";
import { font, rimmed } from "./surface.js";

const INSET = 6;
const TEXT = 12;
/** With more arrows than this, texts that would cover others are left out. */
const MOST_COVERED = 12;
/** Directions from an arrow in which its text may be, from that of the arrow. */
const TURNS = [0, 0.8, -0.8, 1.57, -1.57, 2.4, -2.4, 3.14];

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

/** Paint arrows of one colour. */
export function paintArrows(context, arrows, colour, colours) {
  for (const { from, to, whole } of arrows) {
    paintArrow(context, from, to, colour, 2.4, colours.panel);
    if (!whole) paintBreak(context, from, to, colour, colours.panel);
  }
}

/** Write the texts of all arrows where they cover the least of the boxes taken; adds the box of each. */
export function paintTexts(context, arrows, view, colours, taken) {
  context.font = font(TEXT);
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const arrow of arrows) {
    const { box, covered } = freePlace(context.measureText(arrow.text).width, arrow, view, taken);
    if (covered && arrows.length > MOST_COVERED) continue;
    taken.push(box);
    arrow.box = box;
    rimmed(context, arrow.text, [box[0], (box[1] + box[3]) / 2], colours[arrow.kind], colours.panel);
  }
}

/** The box [left, top, right, bottom] near an arrow that covers the least of those taken. */
function freePlace(width, { from, to }, view, taken) {
  const high = TEXT + 4;
  const heading = Math.atan2(to[1] - from[1], to[0] - from[0]);
  const middle = [(from[0] + to[0]) / 2, (from[1] + to[1]) / 2];
  let best = null;
  for (const gap of [5, 22]) {
    for (const anchor of [to, middle]) {
      for (const turn of TURNS) {
        const [dx, dy] = [Math.cos(heading + turn), Math.sin(heading + turn)];
        const cx = within(anchor[0] + dx * (width / 2 + gap), width / 2 + 4, view.width);
        const cy = within(anchor[1] + dy * (high / 2 + gap), high / 2 + 2, view.height);
        const box = [cx - width / 2, cy - high / 2, cx + width / 2, cy + high / 2];
        const covered = taken.reduce((sum, other) => sum + common(box, other), 0);
        if (!covered) return { box, covered };
        if (!best || covered < best.covered) best = { box, covered };
      }
    }
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

/** How long a round value is drawn; returns the place to the left of it, px. */
export function paintArrowScale(context, view, { unit }, pixels, right, colour, colours) {
  if (!(pixels > 0)) return right;
  const value = roundBelow(Math.min(110, 0.16 * view.width) / pixels);
  const y = view.height - 16;
  const text = roundQuantity(value, unit);
  context.font = font(TEXT);
  context.textAlign = "right";
  context.textBaseline = "alphabetic";
  paintArrow(context, [right - value * pixels, y], [right, y], colour, 2.4);
  rimmed(context, text, [right, y - 9], colours.text, colours.panel);
  return right - Math.max(value * pixels, context.measureText(text).width) - 16;
}
