// Numbered marks at the places to click.
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { circle, through } from "./line";
import { type Colours, font, rimmed } from "./surface";

const RADIUS = 11;

export function paintGhost(
  context: CanvasRenderingContext2D,
  view: View,
  { at, line }: { at: readonly Point[]; line: readonly Point[] },
  colours: Colours,
): void {
  context.save();
  context.strokeStyle = colours.named.accent!;
  context.lineWidth = 2;
  context.setLineDash([6, 5]);
  if (line.length > 1) {
    const points = line.map((one) => view.toScreen(one));
    context.stroke(through(points, false));
  }
  context.setLineDash([4, 3]);
  for (const one of at) context.stroke(circle(view.toScreen(one), RADIUS));
  context.setLineDash([]);
  context.font = font(13, 600);
  context.textAlign = "center";
  context.textBaseline = "middle";
  if (at.length > 1)
    at.forEach((one, k) => {
      const [x, y] = view.toScreen(one);
      const { accent, panel } = colours.named;
      rimmed(context, String(k + 1), [x - RADIUS - 9, y - RADIUS + 2], accent!, panel!);
    });
  context.restore();
}
