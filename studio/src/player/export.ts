// Files that the page offers: pictures, and the plotted curves as a table.
import { type Colours, colourOf, dashOf, font } from "../draw/surface";
import { csv } from "../give/table";
import type { Card } from "./card";
import type { Curve } from "./curve";
import type { Drawing } from "./drawing";
import type { Motion } from "./motion";

/** Pixels of a picture for each pixel of the page. */
const SHARPNESS = 2;
const TITLE = 34;
const ENTRY = 20;
const GAP = 12;

/** What the head of a picture contains: the title, the time, and the time as text. */
export interface Head {
  title: string;
  t: number;
  instant: string;
}

/** Curves at all frames as CSV. A curve of several plots is listed once. */
export function table(motion: Motion, curves: readonly Curve[]): string {
  const distinct = [...new Map(curves.map((curve) => [curve.name, curve])).values()];
  const { name, unit } = motion.variable;
  const units = distinct.map((curve) => plainUnit(curve.unit));
  const names = distinct.map((curve) => curve.name);
  const rows = distinct.map(({ values }) => Float64Array.from(values));
  return csv(Float64Array.from(motion.t), names, units, rows, { name, unit });
}

/** Units as in the tables of kempe: letters of ASCII. */
function plainUnit(unit: string): string {
  return unit.replace("·", "*").replace("²", "^2");
}

/** A picture of the drawing. */
export function drawingPicture(drawing: Drawing, head: Head, colours: Colours): HTMLCanvasElement {
  const { width, height } = drawing.view;
  return picture(width, height + TITLE, colours, (context) => {
    paintHead(context, head, width, colours);
    context.translate(0, TITLE);
    context.beginPath();
    context.rect(0, 0, width, height);
    context.clip();
    drawing.paint(head.t, colours, context);
  });
}

/** A picture of all plots with their legends. */
export function plotsPicture(cards: readonly Card[], head: Head, colours: Colours): HTMLCanvasElement {
  const width = Math.max(...cards.map(({ plot }) => plot.width));
  const columns = Math.max(1, Math.floor(width / 260));
  const rows = ({ entries }: Card) => Math.ceil(entries.length / columns);
  const height = cards.reduce((sum, card) => sum + card.plot.height + ENTRY * rows(card) + GAP, TITLE);
  return picture(width, height, colours, (context) => {
    paintHead(context, head, width, colours);
    context.translate(0, TITLE);
    for (const card of cards) {
      context.save();
      card.plot.paintAll(context, head.t, colours);
      context.restore();
      context.translate(0, card.plot.height);
      card.entries.forEach((entry, k) => {
        paintEntry(context, entry, (k % columns) * (width / columns), Math.floor(k / columns), colours);
      });
      context.translate(0, ENTRY * rows(card) + GAP);
    }
  });
}

function picture(
  width: number,
  height: number,
  colours: Colours,
  paint: (context: CanvasRenderingContext2D) => void,
): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * SHARPNESS);
  canvas.height = Math.round(height * SHARPNESS);
  const context = canvas.getContext("2d")!;
  context.scale(SHARPNESS, SHARPNESS);
  context.fillStyle = colours.named.panel;
  context.fillRect(0, 0, width, height);
  context.lineCap = "round";
  context.lineJoin = "round";
  paint(context);
  return canvas;
}

function paintHead(context: CanvasRenderingContext2D, { title, instant }: Head, width: number, colours: Colours): void {
  context.fillStyle = colours.named.text;
  context.textBaseline = "middle";
  context.font = font(13);
  context.textAlign = "right";
  context.fillText(instant, width - 12, TITLE / 2);
  context.font = font(14, 600);
  context.textAlign = "left";
  context.fillText(title, 12, TITLE / 2, width - 40 - context.measureText(instant).width);
}

function paintEntry(
  context: CanvasRenderingContext2D,
  { curve, value }: Card["entries"][number],
  left: number,
  row: number,
  colours: Colours,
): void {
  const y = ENTRY * (row + 0.5);
  context.strokeStyle = colourOf(curve.number, colours);
  context.lineWidth = 2.5;
  context.setLineDash(dashOf(curve.number));
  context.stroke(new Path2D(`M${left + 12} ${y}h24`));
  context.setLineDash([]);
  context.font = font(12);
  context.textAlign = "left";
  context.textBaseline = "middle";
  context.fillStyle = colours.named.text;
  context.fillText(`${curve.name}  ${value.textContent}`, left + 44, y, 208);
}
