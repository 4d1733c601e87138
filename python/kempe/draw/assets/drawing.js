// The drawing: what is shown of the scene at one instant, and the part of the plane that is seen.
import { paintGravity, paintGrid, paintLengthScale, paintReactions } from "./measure.js";
import { placed } from "./motion.js";
import { paintItems, paintPaths } from "./paint.js";
import { cleared, sharpen } from "./surface.js";
import { extent, View } from "./view.js";

/** Draws the scene on a canvas. */
export class Drawing {
  constructor(canvas, scene, motion) {
    this.canvas = canvas;
    this.scene = scene;
    this.motion = motion;
    this.view = new View(scene.bounds);
    this.shown = { names: true, numbers: true, paths: true, reactions: false };
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

  /** Draw the instant t. */
  paint(t, colours) {
    const { scene, view, shown } = this;
    const context = cleared(this.canvas);
    const now = this.motion.at(t);
    const step = paintGrid(context, view, colours);
    if (shown.paths) paintPaths(context, view, this.traces, colours);
    paintItems(context, view, scene.display, now.poses, shown, colours);
    if (shown.reactions) paintReactions(context, view, this.pins(now), now.forces, this.pixelsPerNewton(), colours);
    paintLengthScale(context, view, step, scene.length, colours);
    paintGravity(context, view, scene.gravity, colours);
  }

  /** Length of reaction arrows; they do not grow when one zooms in. */
  pixelsPerNewton() {
    const { force, length } = this.scene.reaction_scale;
    return (this.magnification * this.view.fitted() * length) / force;
  }
}

function line(points) {
  const path = new Path2D();
  for (const [x, y] of points) path.lineTo(x, y);
  return path;
}
