// Painting of the poses of a task, and of the candidate that is shown.
import type { Candidate, Triple } from "../core/protocol";
import { circle, Line, through } from "../draw/line";
import { type Colours, font, rimmed } from "../draw/surface";
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { pathOf, pinsAt } from "./course";
import { single } from "./task";

/** Radius of the origin of a pose and length of its arm, px. */
export const ORIGIN = 9;
export const ARM = 52;
/** Opacity of the candidate at the poses that are not selected. */
const FAINT = 0.28;

/** The end of the arm of a pose, px. */
export function tipOf(view: View, [x, y, angle]: Triple): Point {
  const [px, py] = view.toScreen([x, y]);
  return [px + ARM * Math.cos(angle), py - ARM * Math.sin(angle)];
}

export function paintPoses(
  context: CanvasRenderingContext2D,
  view: View,
  poses: readonly Triple[],
  active: number | null,
  colours: Colours,
): void {
  const { accent, panel } = colours.named;
  context.save();
  context.setLineDash([]);
  poses.forEach((pose, k) => {
    const at = view.toScreen([pose[0], pose[1]]);
    const tip = tipOf(view, pose);
    context.strokeStyle = accent;
    context.lineWidth = k === active ? 4 : 2.5;
    context.stroke(through([at, tip], false));
    context.fillStyle = panel;
    context.fill(circle(tip, 5));
    context.stroke(circle(tip, 5));
    paintNumber(context, at, k, k === active, colours);
  });
  context.restore();
}

function paintNumber(
  context: CanvasRenderingContext2D,
  at: Point,
  k: number,
  active: boolean,
  { named: { accent, panel, text } }: Colours,
): void {
  const ring = circle(at, ORIGIN);
  context.strokeStyle = accent;
  context.lineWidth = active ? 4 : 2.5;
  context.fillStyle = panel;
  context.fill(ring);
  context.stroke(ring);
  context.font = font(12, 700);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = text;
  context.fillText(String(k + 1), at[0], at[1] + 0.5);
}

/** The points of a path, numbered if they are few, or the line that is being drawn. */
export function paintPath(
  context: CanvasRenderingContext2D,
  view: View,
  points: readonly Triple[],
  active: number | null,
  stroke: readonly Point[],
  colours: Colours,
): void {
  const { accent } = colours.named;
  context.save();
  context.strokeStyle = accent;
  context.lineWidth = 2.5;
  context.stroke(
    through(
      stroke.map((at) => view.toScreen(at)),
      false,
    ),
  );
  if (!stroke.length)
    points.forEach(([x, y], k) => {
      const at = view.toScreen([x, y]);
      if (single.value) paintNumber(context, at, k, k === active, colours);
      else {
        context.fillStyle = accent;
        context.fill(circle(at, 2.5));
      }
    });
  context.restore();
}

/** The candidate: its links at the selected pose, faint at the others, and the path of the coupler; without poses, where
 * it begins. */
export function paintCandidate(
  context: CanvasRenderingContext2D,
  view: View,
  one: Candidate,
  poses: readonly Triple[],
  active: number,
  colours: Colours,
): void {
  context.save();
  const alone = !poses.length;
  context.strokeStyle = alone ? colours.body(2) : colours.named.quiet;
  context.lineWidth = alone ? 2 : 1.5;
  context.setLineDash(alone ? [] : [2, 4]);
  context.stroke(
    through(
      pathOf(one).map((at) => view.toScreen(at)),
      false,
    ),
  );
  context.setLineDash([]);
  poses.forEach((pose, k) => {
    if (k !== active) paintLinks(context, view, one, pose, colours, FAINT);
  });
  const own = alone ? ([...one.points.P, one.frame] as Triple) : poses[active];
  if (own) paintLinks(context, view, one, own, colours, 0.9);
  for (const name of ["O", "D"] as const) paintPivot(context, view.toScreen(one.points[name]), name, colours);
  context.restore();
}

function paintLinks(
  context: CanvasRenderingContext2D,
  view: View,
  one: Candidate,
  pose: Triple,
  colours: Colours,
  opacity: number,
): void {
  const { O, D } = one.points;
  const [a, b] = pinsAt(one, pose);
  const [o, d, pa, pb, p] = [O, D, a, b, [pose[0], pose[1]] as Point].map((at) => view.toScreen(at)) as Point[];
  context.globalAlpha = opacity;
  context.lineWidth = 5;
  const links: [Point[], number][] = [
    [[o!, pa!], 1],
    [[pa!, pb!, p!], 2],
    [[d!, pb!], 3],
  ];
  for (const [points, body] of links) {
    context.strokeStyle = colours.body(body);
    context.fillStyle = colours.body(body);
    const line = through(points, points.length > 2);
    if (points.length > 2) {
      context.globalAlpha = 0.2 * opacity;
      context.fill(line);
      context.globalAlpha = opacity;
    }
    context.stroke(line);
  }
  context.fillStyle = colours.named.panel;
  context.strokeStyle = colours.named.ink;
  context.lineWidth = 1.5;
  for (const pin of [pa!, pb!]) {
    context.fill(circle(pin, 4));
    context.stroke(circle(pin, 4));
  }
  context.globalAlpha = 1;
}

/** A ground pivot with its name. */
function paintPivot(context: CanvasRenderingContext2D, [x, y]: Point, name: string, colours: Colours): void {
  context.globalAlpha = 1;
  context.fillStyle = colours.named.ground;
  context.strokeStyle = colours.named.ground;
  context.lineWidth = 1.5;
  context.stroke(new Line(`M${x} ${y}l-9 14h18z`));
  context.fillStyle = colours.named.panel;
  context.fill(circle([x, y], 4.5));
  context.stroke(circle([x, y], 4.5));
  context.font = font(12, 600);
  context.textAlign = "left";
  context.textBaseline = "middle";
  rimmed(context, name, [x + 12, y + 8], colours.named.text, colours.named.panel);
}
