// The drawn paths of points.
import type { Point } from "../plane/points";
import type { View } from "../plane/view";
import { Line, through } from "./line";
import type { Colours } from "./surface";

/** The path of a point of a body, made once, in metres. Each frame only transforms it to the canvas. */
export class Trace {
  private readonly path: Path2D;

  constructor(
    readonly body: number,
    private readonly points: readonly Point[],
  ) {
    this.path = through(points, false);
  }

  /** Draw the path in a view. */
  seen(view: View): Line {
    const line = new Line(
      () =>
        through(
          this.points.map((at) => view.toScreen(at)),
          false,
        ).text,
    );
    line.addPath(this.path, view.matrix());
    return line;
  }
}

export function paintTraces(
  context: CanvasRenderingContext2D,
  view: View,
  traces: readonly Trace[],
  colours: Colours,
): void {
  context.save();
  context.globalAlpha = 0.55;
  context.lineWidth = 1.5;
  for (const trace of traces) {
    context.strokeStyle = colours.body(trace.body);
    context.stroke(trace.seen(view));
  }
  context.restore();
}
