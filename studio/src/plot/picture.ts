// Plots with their legends as a picture.
import { Line } from "../draw/line";
import { type Colours, colourOf, dashOf, font } from "../draw/surface";
import { HEAD, type Head, paintHead, type Size } from "../give/picture";
import type { Curve } from "./curve";
import type { Plot } from "./plot";

const ENTRY = 20;
const COLUMN = 260;
const GAP = 12;

/** A plot, and the text of each curve in its legend. */
export interface Pictured {
  plot: Plot;
  entries: { curve: Curve; text: string }[];
}

/** The size of a picture of plots, px. */
export function sizeOf(all: readonly Pictured[]): Size {
  const width = Math.max(...all.map(({ plot }) => plot.width));
  const height = all.reduce((sum, one) => sum + one.plot.height + ENTRY * rowsOf(one, width) + GAP, HEAD);
  return { width, height };
}

function columnsOf(width: number): number {
  return Math.max(1, Math.floor(width / COLUMN));
}

function rowsOf({ entries }: Pictured, width: number): number {
  return Math.ceil(entries.length / columnsOf(width));
}

/** Paint plots and legends, one below the other, below the title and the time. */
export function paintPlots(
  context: CanvasRenderingContext2D,
  all: readonly Pictured[],
  head: Head,
  colours: Colours,
): void {
  const { width } = sizeOf(all);
  const columns = columnsOf(width);
  context.save();
  paintHead(context, head, width, colours);
  context.translate(0, HEAD);
  for (const one of all) {
    context.save();
    one.plot.paintAll(context, head.t, colours);
    context.restore();
    context.translate(0, one.plot.height);
    one.entries.forEach(({ curve, text }, k) => {
      paintEntry(context, curve, text, [(k % columns) * (width / columns), Math.floor(k / columns)], colours);
    });
    context.translate(0, ENTRY * rowsOf(one, width) + GAP);
  }
  context.restore();
}

function paintEntry(
  context: CanvasRenderingContext2D,
  curve: Curve,
  text: string,
  [left, row]: [number, number],
  colours: Colours,
): void {
  const y = ENTRY * (row + 0.5);
  context.strokeStyle = colourOf(curve.number, colours);
  context.lineWidth = 2.5;
  context.setLineDash(dashOf(curve.number));
  context.stroke(new Line(`M${left + 12} ${y}h24`));
  context.setLineDash([]);
  context.font = font(12);
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = colours.named.text;
  context.fillText(`${curve.name}  ${text}`, left + 44, y, COLUMN - 52);
}
