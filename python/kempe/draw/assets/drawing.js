// The drawing: what is shown of the scene at one instant, and the part of the plane that is seen.
import { arrowsOf, paintArrows, paintArrowScale, paintTexts } from "./arrows.js";
import { paintGravity, paintGrid, paintLengthScale } from "./measure.js";
import { placed } from "./motion.js";
import { paintItems, paintPaths } from "./paint.js";
import { cleared, sharpen } from "./surface.js";
import { Vectors } from "./vectors.js";
import { extent, View } from "./view.js";

const ARROWS = ["reactions", "velocities", "accelerations"];

/** Draws the scene on a canvas. */
export class Drawing {
  constructor(canvas, scene, motion) {
    this.canvas = canvas;
    this.scene = scene;
    this.motion = motion;
    this.view = new View(scene.bounds);
    this.shown = { names: true, numbers: true, paths: true, reactions: false, velocities: false, accelerations: false };
    this.vectors = new Vectors(scene);
    this.magnification = 1;
    const piece = extent(scene.bounds) / 200;
    this.traces = scene.traces.map(({ body, point }) => ({ body, path: line(motion.path(body, point, piece)) }));
    this.resize();
  }

  /** Take up the size that the canvas has on the page. */
  resize() {
    sharpen(this.canvas);
    const { width, height } = this.canvas.getBoundingClientRect();
    this.view.resize(width, height);
  }

  /** Where the joints are on the canvas at one instant, CSS pixels: their points on body j. */
  pins(now) {
    return this.scene.joints.map(({ name, bodies, points }) => {
      return { name, at: this.view.toScreen(placed(now.poses[bodies[1]], points[1])) };
    });
  }

  /** Draw the instant t, on the canvas of the page or another one. */
  paint(t, colours, context = cleared(this.canvas)) {
    const { scene, view, shown } = this;
    const now = this.motion.at(t);
    const step = paintGrid(context, view, colours);
    if (shown.paths) paintPaths(context, view, this.traces, colours);
    const names = paintItems(context, view, scene.display, now.poses, shown, colours);
    this.arrows = this.paintArrows(context, now, names, colours);
    paintLengthScale(context, view, step, scene.length, colours);
    paintGravity(context, view, scene.gravity, colours);
  }

  /** The arrows that are shown, with their scales; `taken` are the boxes of the names. */
  paintArrows(context, now, taken, colours) {
    const { view } = this;
    let right = view.width - 16;
    const arrows = ARROWS.filter((name) => this.shown[name]).flatMap((name) => {
      const kind = this.vectors.kinds[name];
      const pixels = this.magnification * view.fitted() * kind.length;
      const vectors = this.vectors.of(name, now);
      const places = vectors.map(({ body, at }) => view.toScreen(placed(now.poses[body], at)));
      const found = arrowsOf(vectors, { name, unit: kind.unit }, places, view, pixels);
      paintArrows(context, found, colours[name], colours);
      right = paintArrowScale(context, view, kind, pixels, right, colours[name], colours);
      return found;
    });
    paintTexts(context, arrows, view, colours, taken);
    return arrows;
  }
}

function line(points) {
  const path = new Path2D();
  for (const [x, y] of points) path.lineTo(x, y);
  return path;
}
