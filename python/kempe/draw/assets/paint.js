// Draws bodies, joints, springs and paths at one instant.
import { placed } from "./motion.js";
import { shortened } from "./numbers.js";
import { font, rimmed } from "./surface.js";
import { extent } from "./view.js";

const BAR = 9;
const PIN = 5.5;
const SLIDER = [38, 22];

/** What stands still: a faint grid, and the paths of the traced points. */
export function paintPaths(context, view, traces, colours) {
  context.globalAlpha = 0.55;
  context.lineWidth = 1.5;
  for (const { path, body } of traces) {
    const seen = new Path2D();
    seen.addPath(path, view.matrix());
    context.strokeStyle = colours.body(body);
    context.stroke(seen);
  }
  context.globalAlpha = 1;
}

/** Bodies: bars as rods, others as plates, single points as discs. */
export function paintBodies(context, view, scene, now, colours) {
  for (const { number, outline } of scene.bodies) {
    if (!outline.length) continue;
    const corners = outline.map((corner) => view.toScreen(placed(now.poses[number], corner)));
    const shape = polygon(corners);
    const colour = colours.body(number);
    if (corners.length > 2) {
      context.fillStyle = colours.panel;
      context.fill(shape);
      tinted(context, colour, 0.18, () => context.fill(shape));
    }
    stroked(context, shape, colour, BAR);
    stroked(context, shape, colours.panel, BAR - 3);
    tinted(context, colour, corners.length > 2 ? 0.18 : 0.45, () => context.stroke(shape));
  }
}

function polygon(corners) {
  const shape = new Path2D();
  corners.forEach(([x, y], k) => (k ? shape.lineTo(x, y) : shape.moveTo(x, y)));
  if (corners.length === 1) shape.lineTo(corners[0][0] + 0.01, corners[0][1]);
  if (corners.length > 2) shape.closePath();
  return shape;
}

function stroked(context, shape, colour, width) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.stroke(shape);
}

function tinted(context, colour, alpha, draw) {
  context.globalAlpha = alpha;
  context.fillStyle = context.strokeStyle = colour;
  draw();
  context.globalAlpha = 1;
}

/** Supports under the joints to ground, and crosses on the other points of ground. */
export function paintGround(context, view, scene, pins, colours) {
  context.strokeStyle = colours.ground;
  context.fillStyle = colours.panel;
  context.lineWidth = 1.6;
  const supports = pins.filter((pin) => pin.grounded && !pin.slides).map((pin) => pin.support);
  for (const at of supports) paintSupport(context, at);
  for (const { at } of scene.bodies[0].points) {
    const [x, y] = view.toScreen(at);
    if (supports.some(([a, b]) => Math.hypot(a - x, b - y) < 2)) continue;
    context.stroke(new Path2D(`M${x - 5} ${y}h10M${x} ${y - 5}v10`));
  }
}

function paintSupport(context, [x, y]) {
  const triangle = new Path2D(`M${x} ${y}l-11 19h22z`);
  context.fill(triangle);
  context.stroke(triangle);
  let hatching = `M${x - 18} ${y + 19}h36`;
  for (let k = -14; k <= 18; k += 7) hatching += `M${x + k} ${y + 19}l-6 6`;
  context.stroke(new Path2D(hatching));
}

/** The pins of joints in which bodies turn. */
export function paintPins(context, pins, colours) {
  context.fillStyle = colours.pin;
  context.strokeStyle = colours.text;
  context.lineWidth = 1.8;
  for (const { at, slides, rod } of pins) {
    if (slides) continue;
    for (const [x, y] of rod ?? [at]) {
      const mark = new Path2D();
      mark.arc(x, y, PIN, 0, 2 * Math.PI);
      context.fill(mark);
      context.stroke(mark);
    }
  }
}

/** Massless rods that keep two points at a distance. */
export function paintRods(context, pins, colours) {
  for (const { rod } of pins) {
    if (rod) stroked(context, polygon(rod), colours.ground, 3);
  }
}

/** What sliders slide on: two lines on their body i, hatched outside where that is ground. */
export function paintRails(context, view, scene, now, colours) {
  for (const { bodies: [i], points: [point], axes: [axis], slide } of scene.joints) {
    if (slide === null) continue;
    const pose = now.poses[i];
    const [x, y] = view.toScreen(placed(pose, point));
    const [from, to] = [slide[0] * view.scale - 30, slide[1] * view.scale + 30];
    let rails = "";
    for (const side of [-1, 1]) {
      const edge = side * (SLIDER[1] / 2 + 1.5);
      rails += `M${from} ${edge}H${to}`;
      for (let k = from + 3; i === 0 && k < to; k += 8) rails += `M${k} ${edge}l${-5 * side} ${5 * side}`;
    }
    const turned = new Path2D();
    const degrees = (-(pose[2] + axis) * 180) / Math.PI;
    turned.addPath(new Path2D(rails), new DOMMatrix().translate(x, y).rotate(degrees));
    stroked(context, turned, i === 0 ? colours.ground : colours.body(i), 1.5);
  }
}

/** Sliders: blocks in the colour of their body. */
export function paintSliders(context, pins, colours) {
  const [width, height] = SLIDER;
  for (const { at, angle, body, slides } of pins) {
    if (!slides) continue;
    const block = new Path2D();
    const place = new DOMMatrix().translate(...at).rotate((-angle * 180) / Math.PI);
    block.addPath(new Path2D(`M${-width / 2} ${-height / 2}h${width}v${height}h${-width}z`), place);
    context.fillStyle = colours.panel;
    context.fill(block);
    tinted(context, colours.body(body), 0.3, () => context.fill(block));
    stroked(context, block, colours.body(body), 2);
  }
}

/** Force elements: a spiral for a torsion spring, wound as the spring is; a zigzag beside a dashpot for a
 *  spring-damper between two points; a diamond for others. */
export function paintForces(context, view, scene, now, first, colours) {
  const radius = springRadius(view);
  for (const { type, bodies: [i, j], point, points } of scene.forces) {
    const [x, y] = view.toScreen(placed(now.poses[j], point));
    const [from, to] = [now.poses[i][2], now.poses[j][2]];
    const rest = first.poses[j][2] - first.poses[i][2];
    const shape = type === "spring_damper"
      ? springDamper(...[i, j].map((body, k) => view.toScreen(placed(now.poses[body], points[k]))))
      : type === "torsion_spring"
      ? spiral(x, y, radius, from, 4 * Math.PI + to - from - rest)
      : new Path2D(`M${x} ${y - 9}l9 9l-9 9l-9 -9z`);
    stroked(context, shape, colours.panel, 3.6);
    stroked(context, shape, colours.force, 2);
  }
}

/** Radius of a drawn torsion spring, px. */
export function springRadius(view) {
  return Math.min(40, Math.max(20, 0.05 * view.scale * extent(view.bounds)));
}

/** Archimedes' spiral from the angle `from` on, turning by `turn`. */
function spiral(x, y, radius, from, turn) {
  const shape = new Path2D();
  const steps = Math.min(4000, Math.max(24, Math.ceil(Math.abs(turn) * 10)));
  for (let k = 0; k <= steps; k += 1) {
    const [r, angle] = [PIN + ((radius - PIN) * k) / steps, from + (turn * k) / steps];
    shape.lineTo(x + r * Math.cos(angle), y - r * Math.sin(angle));
  }
  return shape;
}

// A zigzag beside a dashpot: lines as [share of their length, share of half of their width].
const ZIGZAG_AND_DASHPOT = [
  [[0, -0.6], [0, 0.6], [0.1, 0.6], ...[0, 1, 2, 3, 4, 5, 6, 7].map((k) => [0.15 + 0.1 * k, k % 2 ? 0.2 : 1]),
    [0.9, 0.6], [1, 0.6], [1, -0.6], [0.7, -0.6]],
  [[0, -0.6], [0.5, -0.6]],
  [[0.5, -0.9], [0.5, -0.3]],
  [[0.3, -1], [0.7, -1], [0.7, -0.2], [0.3, -0.2]],
];
const HALF_SPRING = 12;

/** A zigzag beside a dashpot between two places on the canvas, with straight lines to both. */
function springDamper([x, y], [toX, toY]) {
  const [dx, dy] = [toX - x, toY - y];
  const length = Math.hypot(dx, dy) || 1;
  const middle = Math.min(0.7, (8 * HALF_SPRING) / length);
  const first = (1 - middle) / 2;
  const inside = ZIGZAG_AND_DASHPOT.map((line) => line.map(([along, aside]) => [first + middle * along, aside]));
  const shape = new Path2D();
  for (const line of [[[0, 0], [first, 0]], ...inside, [[1 - first, 0], [1, 0]]]) {
    line.forEach(([along, aside], k) => {
      const across = (aside * HALF_SPRING) / length;
      const at = [x + along * dx + across * dy, y + along * dy - across * dx];
      if (k) shape.lineTo(...at);
      else shape.moveTo(...at);
    });
  }
  return shape;
}

/** Names beside the joints, on the outside of the mechanism, beside the support of ground. */
export function paintNames(context, view, pins, rooms, colours) {
  context.font = font(14, 600);
  context.textBaseline = "middle";
  const middle = [0, 1].map((k) => pins.reduce((sum, pin) => sum + pin.at[k], 0) / pins.length);
  pins.forEach(({ name, at: [x, y], grounded, slides }, k) => {
    const away = [x - middle[0], y - middle[1]];
    const length = Math.hypot(...away) || 1;
    const [dx, dy] = slides ? [0, 2] : grounded ? [away[0] < 0 ? -0.95 : 0.95, 0.3] : away.map((part) => part / length);
    context.textAlign = dx < -0.3 ? "right" : dx > 0.3 ? "left" : "center";
    const place = [x + rooms[k] * dx, y + (rooms[k] + 2) * dy];
    rimmed(context, shortened(name), inside(context, shortened(name), place, view), colours.text, colours.panel);
  });
}

/** A place for a text, moved sideways so that all of it is seen if its joint is. */
function inside(context, text, [x, y], { width }) {
  if (x < 0 || x > width) return [x, y];
  const { actualBoundingBoxLeft: left, actualBoundingBoxRight: right } = context.measureText(text);
  return [Math.max(left + 6, Math.min(width - right - 6, x)), y];
}

/** The number of each body in a circle at its middle. */
export function paintNumbers(context, view, scene, now, colours) {
  context.font = font(12, 600);
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const { number, outline } of scene.bodies) {
    if (!outline.length) continue;
    const middle = [0, 1].map((k) => outline.reduce((sum, at) => sum + at[k], 0) / outline.length);
    const [x, below] = view.toScreen(placed(now.poses[number], middle));
    const y = outline.length > 1 ? below : below - 26; // not over the pin of a body that is a spot
    const disc = new Path2D();
    disc.arc(x, y, 10, 0, 2 * Math.PI);
    context.fillStyle = colours.panel;
    context.fill(disc);
    stroked(context, disc, colours.body(number), 2);
    context.fillStyle = colours.text;
    context.fillText(String(number), x, y + 0.5);
  }
}
