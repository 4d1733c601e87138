// Painting of a cam and its follower at the angle 0.
import type { CamFound } from "../core/protocol";
import { circle, through } from "../draw/line";
import type { Colours } from "../draw/surface";
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { places, type Sizes } from "./cam";

export function paintCam(
  context: CanvasRenderingContext2D,
  view: View,
  of: CamFound,
  sizes: Sizes,
  colours: Colours,
): void {
  const { quiet, ink } = colours.named;
  const screen = (all: Point[]) => all.map((at) => view.toScreen(at));
  context.save();
  context.lineWidth = 1;
  context.strokeStyle = quiet;
  context.setLineDash([4, 4]);
  context.stroke(circle(view.toScreen([0, 0]), sizes.base_radius * view.scale));
  context.setLineDash([]);
  if (of.curves.pitch) context.stroke(through(screen(places(of.curves.pitch)), true));
  context.lineWidth = 2.5;
  const cam = through(screen(places(of.curves.profile)), true);
  context.fillStyle = colours.body(1);
  context.globalAlpha = 0.15;
  context.fill(cam);
  context.globalAlpha = 1;
  context.strokeStyle = colours.body(1);
  context.stroke(cam);
  for (const other of [of.curves.outer, of.curves.conjugate])
    if (other) context.stroke(through(screen(places(other)), true));
  paintUndercut(context, view, of, colours);
  context.strokeStyle = ink;
  context.lineWidth = 1.5;
  const at = view.toScreen([0, 0]);
  context.stroke(through([[at[0] - 7, at[1]] as Point, [at[0] + 7, at[1]] as Point], false));
  context.stroke(through([[at[0], at[1] - 7] as Point, [at[0], at[1] + 7] as Point], false));
  paintFollower(context, view, of, sizes, colours);
  context.restore();
}

/** The parts of the profile that the follower does not touch. */
function paintUndercut(context: CanvasRenderingContext2D, view: View, of: CamFound, { named }: Colours): void {
  const all = places(of.curves.profile);
  context.strokeStyle = named.problem;
  context.lineWidth = 5;
  for (const [first, last] of of.undercut) {
    const part = all.filter((_, k) => of.angles[k]! >= first && of.angles[k]! <= last);
    context.stroke(
      through(
        part.map((at) => view.toScreen(at)),
        false,
      ),
    );
  }
}

function paintFollower(
  context: CanvasRenderingContext2D,
  view: View,
  { start: { pitch, normal, profile } }: CamFound,
  { follower, motion, direction, base_radius: base, roller_radius: roller, x, y }: Sizes,
  colours: Colours,
): void {
  const end = view.toScreen(pitch);
  const far: Point = motion === "translating" ? [pitch[0], pitch[1] + 1.5 * base] : [x, y];
  const half = follower === "flat" ? 0.8 * base : 0;
  const beside = (way: number): Point => [profile[0] - way * half * normal[1], profile[1] + way * half * normal[0]];
  context.strokeStyle = colours.body(2);
  context.lineWidth = 3;
  context.stroke(through([end, view.toScreen(far)], false));
  if (half) context.stroke(through([view.toScreen(beside(-1)), view.toScreen(beside(1))], false));
  context.fillStyle = colours.named.panel;
  if (follower === "roller") {
    context.fill(circle(end, roller * view.scale));
    context.stroke(circle(end, roller * view.scale));
  }
  if (motion === "oscillating") {
    context.fill(circle(view.toScreen(far), 5));
    context.stroke(circle(view.toScreen(far), 5));
  }
  paintTurn(context, view, (direction === "cw" ? 1 : -1) as 1 | -1, base, colours);
}

/** An arrow around the shaft in the direction of the turn. */
function paintTurn(context: CanvasRenderingContext2D, view: View, side: 1 | -1, base: number, colours: Colours): void {
  const [x, y] = view.toScreen([0, 0]);
  const radius = 0.45 * base * view.scale;
  const on = (angle: number, far = radius): Point => [x + far * Math.cos(angle), y + far * Math.sin(angle)];
  const arc = Array.from({ length: 25 }, (_, k) => on(side * (0.4 + (k / 24) * 1.6)));
  const tip = side * 2;
  context.strokeStyle = colours.named.quiet;
  context.lineWidth = 1.5;
  context.stroke(through(arc, false));
  context.stroke(through([on(tip - side * 0.22, 0.86 * radius), on(tip), on(tip - side * 0.22, 1.14 * radius)], false));
}
