// Velocity and acceleration polygons. Each point has an image: the tip of its velocity from the pole o, or of its acceleration.
// The images of two points of a body are joined by ω × r, or by -ω² r and α × r; those of a slide and of the point below it by
// the sliding velocity, or by Coriolis' part 2 ω × v and the part along the slide.
import type { Instant } from "../core/protocol";
import type { Point } from "../plane/points";
import { accelerationAt, dot, minus, placeOf, plus, seenFrom, size, times, turned, velocityAt } from "./points";

export const POLE = "o";
/** Points closer than this fraction of their distance from the origin are one point. */
const SAME = 1e-9;

export type Part = "absolute" | "relative" | "normal" | "tangential" | "slip" | "coriolis";

/** A vector of a polygon, from `start`. */
export interface Side {
  name: string;
  part: Part;
  start: Point;
  vector: Point;
}

export interface Polygon {
  /** The images of points by name. */
  images: Map<string, Point>;
  sides: Side[];
}

interface Named {
  name: string;
  body: number;
  s: Point;
}

export type Bodies = readonly { name: string; points: Record<string, Point> }[];

/** The polygon of velocities or of accelerations at an instant. */
export function polygonOf(kind: "velocity" | "acceleration", instant: Instant, bodies: Bodies): Polygon {
  const { bodies: all } = instant;
  const points = pointsOf(instant, bodies);
  const place = ({ body, s }: Named) => placeOf(all[body]!, s);
  const velocity = (one: Named) => velocityAt(all[one.body]!, place(one));
  const image = kind === "velocity" ? velocity : (one: Named) => accelerationAt(all[one.body]!, place(one));
  const images = new Map(points.map((one) => [one.name, image(one)]));
  const sides: Side[] = [];
  const add = (name: string, part: Part, start: Point, vector: Point) => {
    sides.push({ name, part, start, vector });
    return plus(start, vector);
  };
  for (const [name, at] of images) if (name !== POLE) add(name, "absolute", [0, 0], at);
  for (const [a, b] of pairs(instant, points)) {
    const { rate, acceleration } = all[a.body]!;
    const [name, start, r] = [b.name + a.name, images.get(a.name)!, minus(place(b), place(a))];
    if (kind === "velocity") add(name, "relative", start, times(rate[2], turned(r)));
    else {
      const middle = add(name, "normal", start, times(-(rate[2] ** 2), r));
      add(name, "tangential", middle, times(acceleration?.[2] ?? Number.NaN, turned(r)));
    }
  }
  for (const { under, own, along } of slides(instant, points)) {
    const [name, start] = [own.name + under.name, images.get(under.name)!];
    const slip = times(dot(minus(velocity(own), velocity(under)), along), along);
    if (kind === "velocity") add(name, "slip", start, slip);
    else {
      const coriolis = times(2 * all[under.body]!.rate[2], turned(slip));
      const middle = add(name, "coriolis", start, coriolis);
      const whole = minus(images.get(own.name)!, images.get(under.name)!);
      add(name, "slip", middle, times(dot(minus(whole, coriolis), along), along));
    }
  }
  return { images: images.set(POLE, [0, 0]), sides };
}

/** The pole, then pins, slides and free named points. A pin occurs once for each of its bodies; points of ground are the pole. */
function pointsOf(instant: Instant, bodies: Bodies): Named[] {
  const found: Named[] = [{ name: POLE, body: 0, s: [0, 0] }];
  for (const { name, slides, bodies: both, points } of instant.joints) {
    const [i, j] = both;
    if (!slides) {
      const label = both.includes(0) ? POLE : name;
      found.push({ name: label, body: i, s: points[0] }, { name: label, body: j, s: points[1] });
      continue;
    }
    found.push({ name, body: j, s: points[1] });
    if (i === 0) continue;
    const s = seenFrom(instant.bodies[i]!, placeOf(instant.bodies[j]!, points[1]));
    found.push({ name: `${name}′`, body: i, s });
  }
  const joints = [...found];
  const names = bodies.slice(1).flatMap((body) => Object.keys(body.points));
  bodies.forEach((about, body) => {
    if (!body) return;
    for (const [point, s] of Object.entries(about.points)) {
      const single = names.filter((name) => name === point).length === 1;
      if (!joints.some((one) => one.body === body && near(one.s, s)))
        found.push({ name: single ? point : `${about.name}.${point}`, body, s });
    }
  });
  return found.filter((one, k) => !found.slice(0, k).some((each) => each.body === one.body && near(each.s, one.s)));
}

function near(a: Point, b: Point): boolean {
  return size(minus(a, b)) <= SAME * (1 + size(a));
}

/** The first point of each turning body with each of its other points. A point of the pole is first. */
function pairs({ bodies }: Instant, points: readonly Named[]): [Named, Named][] {
  return bodies.flatMap(({ turns }, body) => {
    const own = points.filter((one) => one.body === body);
    const first = own.find(({ name }) => name === POLE) ?? own[0];
    return body && turns && first ? own.filter((one) => one !== first).map((one): [Named, Named] => [first, one]) : [];
  });
}

/** Slides on moving bodies: the point below the slide, its own point, and the direction of the line. */
function slides({ bodies, joints }: Instant, points: readonly Named[]): { under: Named; own: Named; along: Point }[] {
  return joints.flatMap(({ name, bodies: [i, j], axis }) => {
    const under = points.find((one) => one.name === `${name}′` && one.body === i);
    const own = points.find((one) => one.name === name && one.body === j);
    if (!under || !own) return [];
    const angle = bodies[i]!.pose[2] + axis;
    return [{ under, own, along: [Math.cos(angle), Math.sin(angle)] as Point }];
  });
}
