// An area on the sheet: what its outlines surround, without holes.
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { Line, through } from "./line";
import type { Colours } from "./surface";

/** Fill an area and draw its outlines. An outline within another one surrounds a hole. */
export function paintArea(
  context: CanvasRenderingContext2D,
  view: View,
  outlines: readonly (readonly Point[])[],
  colours: Colours,
): void {
  if (!outlines.length) return;
  const lines = outlines.map((outline) =>
    through(
      outline.map((at) => view.toScreen(at)),
      true,
    ),
  );
  const all = new Line(lines.map(({ text }) => text).join(""));
  context.save();
  context.fillStyle = colours.named.accent;
  context.globalAlpha = 0.16;
  context.fill(all, "evenodd");
  context.globalAlpha = 0.8;
  context.strokeStyle = colours.named.accent;
  context.lineWidth = 1.5;
  context.stroke(all);
  context.restore();
}
