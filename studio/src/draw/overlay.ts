// Marks above the mechanism: handles of points, the selection, the line in progress, pulls of the mouse.
import type { Body } from "../core/protocol";
import { hull, type Placement, type Point, placed } from "../plane/points";
import type { View } from "../plane/view";
import { paintArrow } from "./arrow";
import { circle, Line, through } from "./line";
import { type Colours, font, rimmed } from "./surface";

const HANDLE = 4;

/** A thin skeleton of all bodies. It is drawn until the display list arrives. */
export function paintLinks(
  context: CanvasRenderingContext2D,
  view: View,
  bodies: readonly Body[],
  poses: readonly Placement[],
  colours: Colours,
): void {
  bodies.forEach((body, k) => {
    const pose = poses[k];
    if (!pose || body.ground) return;
    const points = hull(Object.values(body.points).map((at) => view.toScreen(placed(pose, at))));
    context.strokeStyle = colours.body(k);
    context.lineWidth = 6;
    context.stroke(through(points, points.length > 2));
  });
}

/** Handles at all points. */
export function paintHandles(
  context: CanvasRenderingContext2D,
  view: View,
  points: readonly Point[],
  colours: Colours,
): void {
  context.lineWidth = 1.5;
  for (const at of points) {
    const ring = circle(view.toScreen(at), HANDLE);
    context.fillStyle = colours.named.panel;
    context.fill(ring);
    context.strokeStyle = colours.named.ink;
    context.stroke(ring);
  }
}

/** A glow around the selected body. */
export function paintSelectedBody(
  context: CanvasRenderingContext2D,
  view: View,
  body: Body,
  pose: Placement,
  colours: Colours,
): void {
  const points = hull(Object.values(body.points).map((at) => view.toScreen(placed(pose, at))));
  if (!points.length) points.push(view.toScreen(placed(pose, body.center)));
  context.save();
  context.globalAlpha = 0.28;
  context.strokeStyle = colours.named.accent;
  context.lineWidth = 26;
  context.stroke(through(points.length > 1 ? points : [points[0]!, points[0]!], points.length > 2));
  context.restore();
}

/** A ring around the selected place. */
export function paintRing(
  context: CanvasRenderingContext2D,
  view: View,
  at: Point,
  colours: Colours,
  radius = 12,
  colour: "accent" | "problem" = "accent",
): void {
  context.strokeStyle = colours.named[colour];
  context.lineWidth = 2.5;
  context.stroke(circle(view.toScreen(at), radius));
}

/** The line in progress, with its length and direction. */
export function paintLine(
  context: CanvasRenderingContext2D,
  view: View,
  line: readonly Point[],
  closed: boolean,
  label: string,
  colours: Colours,
): void {
  if (line.length < 2) return;
  const points = line.map((at) => view.toScreen(at));
  context.save();
  context.strokeStyle = colours.named.accent;
  context.globalAlpha = 0.75;
  context.lineWidth = 8;
  context.stroke(through(points, closed && points.length > 2));
  context.restore();
  if (!label) return;
  const [a, b] = points.slice(-2) as [Point, Point];
  const slope = Math.abs(Math.atan2(b[1] - a[1], Math.abs(b[0] - a[0])));
  const beside = 20 + 0.5 * context.measureText(label).width * Math.sin(slope);
  context.font = font(13, 600);
  context.textAlign = "center";
  context.textBaseline = "middle";
  rimmed(context, label, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2 - beside], colours.named.text, colours.named.panel);
}

/** The place that a click would choose. The form of the mark gives the reason for this place. */
export function paintMark(
  context: CanvasRenderingContext2D,
  view: View,
  at: Point,
  kind: string,
  colours: Colours,
): void {
  const [x, y] = view.toScreen(at);
  context.strokeStyle = colours.named.accent;
  context.lineWidth = 1.8;
  if (kind === "point") paintRing(context, view, at, colours, 9);
  else context.stroke(new Line(`M${x - 7} ${y}h14M${x} ${y - 7}v14`));
}

/** A pull of the mouse. */
export function paintPull(
  context: CanvasRenderingContext2D,
  view: View,
  from: Point,
  to: Point,
  colours: Colours,
): void {
  context.save();
  context.setLineDash([5, 4]);
  paintArrow(context, view.toScreen(from), view.toScreen(to), colours.named.accent, 2);
  context.restore();
}
