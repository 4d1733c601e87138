// Pictures of the drawing.
import { paperPalette } from "../draw/surface";
import { SvgContext } from "../draw/svg";
import { paintSheet } from "../page/painting";
import { view } from "../store/sheet";
import { title } from "../store/state";
import { download, nameOf } from "./download";

/** Pixels of a picture for each pixel of the page. */
const SHARPNESS = 2;

/** Save the drawing as SVG, on white paper. */
export function saveSvg(): void {
  const svg = new SvgContext(document.createElement("canvas").getContext("2d")!);
  const colours = paperPalette();
  paintSheet(svg.context, colours, true);
  const picture = svg.written(Math.round(view.width), Math.round(view.height), colours.named.panel);
  download(nameOf(title.value, ".svg"), picture, "image/svg+xml");
}

/** Save the drawing as PNG, on white paper. */
export function saveDrawing(): void {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(view.width * SHARPNESS);
  canvas.height = Math.round(view.height * SHARPNESS);
  const context = canvas.getContext("2d")!;
  const colours = paperPalette();
  context.scale(SHARPNESS, SHARPNESS);
  context.fillStyle = colours.named.panel;
  context.fillRect(0, 0, view.width, view.height);
  context.lineCap = "round";
  context.lineJoin = "round";
  paintSheet(context, colours, true);
  canvas.toBlob((blob) => blob && download(nameOf(title.value, ".png"), blob, "image/png"), "image/png");
}
