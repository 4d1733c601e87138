// The drawing: what is shown of the scene at one instant, and the part of the plane that is seen.
import { arrowsOf, paintArrows, paintArrowScale } from "./arrows.js";
import { paintGravity, paintGrid, paintLengthScale } from "./measure.js";
import { placed } from "./motion.js";
import { paintItems, paintPaths } from "./paint.js";
import { cleared, sharpen } from "./surface.js";
import { Vectors } from "./vectors.js";
import { extent, View } from "./view.js";

/** From this layer on items are painted over the arrows. */
const PIN = 3;
const ARROWS = ["reactions", "velocities", "accelerations"];

/** Draws the scene on a canvas. */
export class Drawing {
  constructor(canvas, scene, motion) {
    this.canvas = canvas;
    this.scene = scene;
    this.motion = motion;
    this.view = new View(scene.bounds);
    this.shown = { names: true, numbers: true, paths: true, reactions: false, velocities: false, accelerations: false };
    this.vectors = new Vectors(scene, motion);
    this.magnification = 1;
    this.below = scene.display.filter(({ layer }) => layer < PIN);
    this.above = scene.display.filter(({ layer }) => layer >= PIN);
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
    const paint = (items) => paintItems(context, view, items, now.poses, shown, colours);
    paint(this.below);
    paint(this.above);
    this.arrows = this.paintArrows(context, now, colours);
    paintLengthScale(context, view, step, scene.length, colours);
    paintGravity(context, view, scene.gravity, colours);
  }

  /** The arrows that are shown, with their scales. */
  paintArrows(context, now, colours) {
    const { view } = this;
    const taken = [];
    return ARROWS.filter((kind) => this.shown[kind]).flatMap((name, row) => {
      const kind = this.vectors.kinds[name];
      const pixels = this.magnification * view.fitted() * kind.length;
      const vectors = this.vectors.of(name, now);
      const places = vectors.map(({ body, at }) => view.toScreen(placed(now.poses[body], at)));
      const arrows = arrowsOf(vectors, { name, unit: kind.unit }, places, view, pixels);
      paintArrows(context, arrows, view, colours[name], colours, taken);
      paintArrowScale(context, view, kind, pixels, row, colours[name], colours);
      return arrows;
    });
  }
}

function line(points) {
  const path = new Path2D();
  for (const [x, y] of points) path.lineTo(x, y);
  return path;
}
