// The drawing: what is shown of the scene at one instant, and the part of the plane that is seen.
import { paintGravity, paintGrid, paintLengthScale, paintReactions } from "./measure.js";
import { placed } from "./motion.js";
import { paintBodies, paintForces, paintGround, paintNames, paintNumbers, paintPaths, paintPins, paintRails, paintRods, paintSliders, springRadius } from "./paint.js";
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
    this.first = motion.at(motion.begin);
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

  /** Where the joints are on the canvas at one instant, CSS pixels; drawn on body j. */
  pins(now) {
    return this.scene.joints.map(({ name, type, bodies: [i, j], points, axes, slide }) => {
      const ends = [i, j].map((body, k) => this.view.toScreen(placed(now.poses[body], points[k])));
      return {
        name,
        body: j,
        slides: slide !== null,
        angle: now.poses[j][2] + axes[1],
        grounded: i === 0 || j === 0,
        at: ends[1],
        support: ends[i === 0 && type === "distance" ? 0 : 1],
        rod: type === "distance" ? ends : null,
      };
    });
  }

  /** How far from each joint its name must stay, px: there may be a spring or a slider. */
  rooms(now, pins) {
    const { scene, view } = this;
    const spirals = scene.forces.filter(({ points }) => points === null);
    const springs = spirals.map(({ bodies, point }) => view.toScreen(placed(now.poses[bodies[1]], point)));
    const sliders = pins.filter(({ slides }) => slides).map(({ at }) => at);
    const near = ([x, y], others) => others.some(([a, b]) => Math.hypot(a - x, b - y) < 4);
    const room = (at) => (near(at, springs) ? springRadius(view) + 6 : near(at, sliders) ? 27 : 15);
    return pins.map(({ at, slides }) => (slides ? 15 : room(at)));
  }

  /** Draw the instant t. */
  paint(t, colours) {
    const { scene, view, shown } = this;
    const context = cleared(this.canvas);
    const now = this.motion.at(t);
    const pins = this.pins(now);
    const step = paintGrid(context, view, colours);
    if (shown.paths) paintPaths(context, view, this.traces, colours);
    paintGround(context, view, scene, pins, colours);
    paintRails(context, view, scene, now, colours);
    paintBodies(context, view, scene, now, colours);
    paintSliders(context, pins, colours);
    paintRods(context, pins, colours);
    paintForces(context, view, scene, now, this.first, colours);
    if (shown.reactions) paintReactions(context, view, pins, now.forces, this.pixelsPerNewton(), colours);
    paintPins(context, pins, colours);
    if (shown.numbers) paintNumbers(context, view, scene, now, colours);
    if (shown.names) paintNames(context, view, pins, this.rooms(now, pins), colours);
    paintLengthScale(context, view, step, colours);
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
