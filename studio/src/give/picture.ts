// Pictures for files: on white paper, as pixels or as SVG.
import { type Colours, font, paperPalette } from "../draw/surface";
import { SvgContext } from "../draw/svg";
import { download } from "./download";

/** Pixels of a picture for each pixel of the page. */
const SHARPNESS = 2;
/** Height of the head, px. */
export const HEAD = 34;

export interface Size {
  width: number;
  height: number;
}

type Paint = (context: CanvasRenderingContext2D, colours: Colours) => void;

/** The head of a picture: the title, the time, and the time as text. */
export interface Head {
  title: string;
  t: number;
  instant: string;
}

export function paintHead(
  context: CanvasRenderingContext2D,
  { title, instant }: Head,
  width: number,
  colours: Colours,
): void {
  context.fillStyle = colours.named.text;
  context.textBaseline = "middle";
  context.font = font(13);
  context.textAlign = "right";
  context.fillText(instant, width - 12, HEAD / 2);
  const room = width - 40 - context.measureText(instant).width;
  context.font = font(14, 600);
  context.textAlign = "left";
  context.fillText(title, 12, HEAD / 2, room);
}

/** Offer a picture as PNG. */
export function savePng(name: string, { width, height }: Size, paint: Paint): void {
  const canvas = document.createElement("canvas");
  canvas.width = Math.round(width * SHARPNESS);
  canvas.height = Math.round(height * SHARPNESS);
  const context = canvas.getContext("2d")!;
  const colours = paperPalette();
  context.scale(SHARPNESS, SHARPNESS);
  context.fillStyle = colours.named.panel;
  context.fillRect(0, 0, width, height);
  context.lineCap = "round";
  context.lineJoin = "round";
  paint(context, colours);
  canvas.toBlob((blob) => blob && download(name, blob, "image/png"), "image/png");
}

/** A picture as SVG. */
export function svgOf({ width, height }: Size, paint: Paint): string {
  const svg = new SvgContext(document.createElement("canvas").getContext("2d")!);
  const colours = paperPalette();
  paint(svg.context, colours);
  return svg.written(Math.round(width), Math.round(height), colours.named.panel);
}

/** Offer a picture as SVG. */
export function saveSvg(name: string, size: Size, paint: Paint): void {
  download(name, svgOf(size, paint), "image/svg+xml");
}
