// Files that the page offers: pictures, and the plotted curves as a table.
import { nameOf } from "../give/download";
import { HEAD, type Head, paintHead, savePng } from "../give/picture";
import { csv } from "../give/table";
import { paintPlots, sizeOf } from "../plot/picture";
import type { Card } from "./card";
import type { SceneCurve } from "./curve";
import type { Drawing } from "./drawing";
import type { Motion } from "./motion";

/** Curves at all frames as CSV. A curve of several plots is listed once. */
export function table(motion: Motion, curves: readonly SceneCurve[]): string {
  const distinct = [...new Map(curves.map((curve) => [curve.name, curve])).values()];
  const units = distinct.map((curve) => plainUnit(curve.unit));
  const names = distinct.map((curve) => curve.name);
  const rows = distinct.map(({ values }) => Float64Array.from(values));
  return csv(Float64Array.from(motion.t), names, units, rows, motion.variable);
}

/** Units as in the tables of kempe: letters of ASCII. */
function plainUnit(unit: string): string {
  return unit.replace("·", "*").replace("²", "^2");
}

/** A picture of the drawing. */
export function saveDrawing(drawing: Drawing, head: Head): void {
  const { width, height } = drawing.view;
  savePng(nameOf(head.title, "_drawing.png"), { width, height: height + HEAD }, (context, colours) => {
    paintHead(context, head, width, colours);
    context.translate(0, HEAD);
    context.beginPath();
    context.rect(0, 0, width, height);
    context.clip();
    drawing.paint(head.t, colours, context);
  });
}

/** A picture of all plots with their legends. */
export function savePlots(cards: readonly Card[], head: Head): void {
  const all = cards.map(({ plot, entries }) => ({
    plot,
    entries: entries.map(({ curve, value }) => ({ curve, text: value.textContent ?? "" })),
  }));
  savePng(nameOf(head.title, "_plots.png"), sizeOf(all), (context, colours) => paintPlots(context, all, head, colours));
}
