// Pictures of the drawing.
import { paintSheet } from "../page/painting";
import { view } from "../store/sheet";
import { title } from "../store/state";
import { nameOf } from "./download";
import { savePng, saveSvg, svgOf } from "./picture";

export function saveDrawingSvg(): void {
  saveSvg(nameOf(title.value, ".svg"), view, (context, colours) => paintSheet(context, colours, true));
}

/** The drawing as SVG. */
export function drawingSvg(): string {
  return svgOf(view, (context, colours) => paintSheet(context, colours, true));
}

export function saveDrawing(): void {
  savePng(nameOf(title.value, ".png"), view, (context, colours) => paintSheet(context, colours, true));
}
