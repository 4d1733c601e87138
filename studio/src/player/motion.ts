// The motion of the scene: positions, rates and forces at any time. It needs no screen.
import { placeIn } from "../plane/instants";
import { type Placement, type Point, placed } from "../plane/points";
import type { Scene } from "./scene";

const GROUND: Placement = [0, 0, 0];

/** The frames around a time: the share of the way from one to the other, and the time between them. */
interface Place {
  low: number;
  high: number;
  h: number;
  share: number;
}

/** Everything at one time; ground is the first body. */
export interface Instant {
  t: number;
  poses: Placement[];
  rates: Placement[];
  accelerations: Placement[];
  /** The force of each joint on its body j. */
  forces: Point[];
  /** The frames before and after it. */
  place: Pick<Place, "low" | "high" | "share">;
}

/** A motion over the frames of a scene. */
export class Motion {
  readonly t: number[];
  readonly variable: Scene["variable"];
  readonly begin: number;
  readonly end: number;
  readonly smooth: boolean;

  constructor(private readonly scene: Scene) {
    this.t = scene.frames.t;
    this.variable = scene.variable;
    this.begin = this.t[0]!;
    this.end = this.t[this.t.length - 1]!;
    this.smooth = scene.interpolation === "cubic";
  }

  /** The frame that begins before t, and the share of the way to the next one. */
  place(t: number): Place {
    const { low, high, share } = placeIn(this.t, t);
    return { low, high, h: this.t[high]! - this.t[low]!, share: this.smooth ? share : Math.round(share) };
  }

  /** The variable of the frames as text, such as `0.250 s` or `30.000°`. */
  written(t: number, decimals: number): string {
    return this.withUnit((t / this.variable.divisor).toFixed(decimals));
  }

  withUnit(number: string | number): string {
    const { shown } = this.variable;
    return `${number}${shown === "°" ? "" : " "}${shown}`;
  }

  /** The same with its name, such as `t = 0.250 s`. */
  named(t: number, decimals: number): string {
    return `${this.variable.name} = ${this.written(t, decimals)}`;
  }

  /** The frame nearest to t. */
  nearest(t: number): number {
    const { low, high } = this.place(t);
    return t - this.t[low]! < this.t[high]! - t ? low : high;
  }

  at(t: number): Instant {
    const place = this.place(t);
    const { poses, rates, accelerations, reactions } = this.scene.frames;
    const bodies = poses[place.low]!.map((_, body) => body);
    return {
      t,
      poses: [GROUND, ...bodies.map((body) => hermite(poses, rates, body, place))],
      rates: [GROUND, ...bodies.map((body) => hermite(rates, accelerations, body, place))],
      accelerations: [GROUND, ...bodies.map((body) => linear(accelerations, body, place))],
      forces: reactions[place.low]!.map((_, joint) => linear(reactions, joint, place)),
      place,
    };
  }

  /** Everything at frame k. */
  frame(k: number): Instant {
    const { poses, rates, accelerations, reactions } = this.scene.frames;
    const [pose, rate, acceleration] = [poses, rates, accelerations].map((all) => [GROUND, ...all[k]!]);
    const place = { low: k, high: k, share: 0 };
    return { t: this.t[k]!, poses: pose!, rates: rate!, accelerations: acceleration!, forces: reactions[k]!, place };
  }

  /** Value at t of a curve: `values` at the frames and their `slopes`. */
  value({ values, slopes }: { values: number[]; slopes: number[] }, t: number): number {
    const { low, high, h, share } = this.place(t);
    if (share === 0) return values[low]!;
    if (share === 1) return values[high]!;
    return cubic([values[low]!, values[high]!], [slopes[low]!, slopes[high]!], h, share);
  }

  /** Slopes of values at the frames, by central differences. */
  slopes(values: number[]): number[] {
    const last = values.length - 1;
    return values.map((_, k) => {
      const [a, b] = [Math.max(0, k - 1), Math.min(last, k + 1)];
      return b > a ? (values[b]! - values[a]!) / (this.t[b]! - this.t[a]!) : 0;
    });
  }

  /** The path of a point of a body, in pieces of about the length `piece` where it is smooth. */
  path(body: number, point: Point, piece: number): Point[] {
    const { poses, rates } = this.scene.frames;
    const at = (place: Place) => placed(hermite(poses, rates, body - 1, place), point);
    const path = [at({ low: 0, high: 0, h: 0, share: 0 })];
    for (let high = 1; high < poses.length; high += 1) {
      const place = { low: high - 1, high, h: this.t[high]! - this.t[high - 1]! };
      const [[x0, y0], [x1, y1]] = [path[path.length - 1]!, at({ ...place, share: 1 })];
      const count = this.smooth ? Math.min(8, Math.ceil(Math.hypot(x1 - x0, y1 - y0) / piece)) : 1;
      for (let k = 1; k < count; k += 1) path.push(at({ ...place, share: k / count }));
      path.push([x1, y1]);
    }
    return path;
  }
}

/** Velocity of a point of a body: ṙ + ω B s (Haug 2.6.6). */
export function velocity(now: Instant, body: number, point: Point): Point {
  const [dx, dy] = arm(now.poses[body]!, point);
  const [vx, vy, omega] = now.rates[body]!;
  return [vx - omega * dy, vy + omega * dx];
}

/** Acceleration of a point of a body: r̈ + α B s - ω² A s (Haug 2.6.8). */
export function acceleration(now: Instant, body: number, point: Point): Point {
  const [dx, dy] = arm(now.poses[body]!, point);
  const [ax, ay, alpha] = now.accelerations[body]!;
  const square = now.rates[body]![2] ** 2;
  return [ax - alpha * dy - square * dx, ay + alpha * dx - square * dy];
}

/** A s: the global components of a vector of a body. */
function arm([, , angle]: Placement, s: Point): Point {
  return placed([0, 0, angle], s);
}

/** Hermite's cubic polynomial through the rows of two frames with the given rates. */
function hermite(rows: Placement[][], rates: Placement[][], body: number, { low, high, h, share }: Place): Placement {
  const [p, q, u, v] = [rows[low]![body]!, rows[high]![body]!, rates[low]![body]!, rates[high]![body]!];
  const at = (k: 0 | 1 | 2) => cubic([p[k], q[k]], [u[k], v[k]], h, share);
  return [at(0), at(1), at(2)];
}

function cubic([p, q]: Point, [u, v]: Point, h: number, s: number): number {
  if (s === 0) return p;
  if (s === 1) return q;
  const r = 1 - s;
  return r * r * (1 + 2 * s) * p + s * s * (1 + 2 * r) * q + h * r * s * (r * u - s * v);
}

function linear<Row extends readonly number[]>(values: Row[][], which: number, { low, high, share }: Place): Row {
  const [a, b] = [values[low]![which]!, values[high]![which]!];
  return a.map((value, k) => value * (1 - share) + b[k]! * share) as unknown as Row;
}
