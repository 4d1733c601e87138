// The motion of the scene: where everything is at any time, and how it moves. It needs no screen.

const GROUND = [0, 0, 0];

/** A motion over the frames of a scene. */
export class Motion {
  constructor(scene) {
    this.scene = scene;
    this.t = scene.frames.t;
    this.variable = scene.variable;
    this.begin = this.t[0];
    this.end = this.t[this.t.length - 1];
    this.smooth = scene.interpolation === "cubic";
  }

  /** The frame that begins before t, and the share of the way to the next one. */
  place(t) {
    let low = 0;
    let high = this.t.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.t[middle] <= t) low = middle;
      else high = middle;
    }
    const h = this.t[high] - this.t[low];
    const share = h > 0 ? (t - this.t[low]) / h : 0;
    return { low, high, h, share: this.smooth ? share : Math.round(share) };
  }

  /** The variable of the frames as text, such as `0.250 s` or `30.000°`. */
  written(t, decimals) {
    return this.withUnit((t / this.variable.divisor).toFixed(decimals));
  }

  withUnit(number) {
    const { shown } = this.variable;
    return `${number}${shown === "°" ? "" : " "}${shown}`;
  }

  /** The same with its name, such as `t = 0.250 s`. */
  named(t, decimals) {
    return `${this.variable.name} = ${this.written(t, decimals)}`;
  }

  /** The frame nearest to t. */
  nearest(t) {
    const { low, high } = this.place(t);
    return t - this.t[low] < this.t[high] - t ? low : high;
  }

  /** Everything at t: pose, rates and accelerations of each body, ground first, and the force of each joint. */
  at(t) {
    const place = this.place(t);
    const { poses, rates, accelerations, reactions } = this.scene.frames;
    const bodies = poses[place.low].map((_, body) => body);
    const forces = reactions[place.low].map((_, joint) => linear(reactions, joint, place));
    return {
      t,
      poses: [GROUND, ...bodies.map((body) => hermite(poses, rates, body, place))],
      rates: [GROUND, ...bodies.map((body) => hermite(rates, accelerations, body, place))],
      accelerations: [GROUND, ...bodies.map((body) => linear(accelerations, body, place))],
      forces,
    };
  }

  /** Everything at frame k. */
  frame(k) {
    const { poses, rates, accelerations, reactions } = this.scene.frames;
    const [pose, rate, acceleration] = [poses, rates, accelerations].map((all) => [GROUND, ...all[k]]);
    return { t: this.t[k], poses: pose, rates: rate, accelerations: acceleration, forces: reactions[k] };
  }

  /** Value at t of a curve: `values` at the frames and their `slopes`. */
  value({ values, slopes }, t) {
    const { low, high, h, share } = this.place(t);
    if (share === 0) return values[low];
    if (share === 1) return values[high];
    return cubic([values[low], values[high]], [slopes[low], slopes[high]], h, share);
  }

  /** Slopes of values at the frames, by central differences. */
  slopes(values) {
    const last = values.length - 1;
    return values.map((_, k) => {
      const [a, b] = [Math.max(0, k - 1), Math.min(last, k + 1)];
      return b > a ? (values[b] - values[a]) / (this.t[b] - this.t[a]) : 0;
    });
  }

  /** The path of a point of a body, in pieces of about the length `piece` where it is smooth. */
  path(body, point, piece) {
    const { poses, rates } = this.scene.frames;
    const at = (place) => placed(hermite(poses, rates, body - 1, place), point);
    const path = [at({ low: 0, high: 0, h: 0, share: 0 })];
    for (let high = 1; high < poses.length; high += 1) {
      const place = { low: high - 1, high, h: this.t[high] - this.t[high - 1] };
      const [[x0, y0], [x1, y1]] = [path[path.length - 1], at({ ...place, share: 1 })];
      const count = this.smooth ? Math.min(8, Math.ceil(Math.hypot(x1 - x0, y1 - y0) / piece)) : 1;
      for (let k = 1; k < count; k += 1) path.push(at({ ...place, share: k / count }));
      path.push([x1, y1]);
    }
    return path;
  }
}

/** Where a point of a body with this pose is. */
export function placed([x, y, angle], [a, b]) {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [x + cos * a - sin * b, y + sin * a + cos * b];
}

/** Velocity of a point of a body: ṙ + ω B s (Haug 2.6.6). */
export function velocity(now, body, point) {
  const [[dx, dy], [vx, vy, omega]] = [arm(now.poses[body], point), now.rates[body]];
  return [vx - omega * dy, vy + omega * dx];
}

/** Acceleration of a point of a body: r̈ + α B s - ω² A s (Haug 2.6.8). */
export function acceleration(now, body, point) {
  const [[dx, dy], [ax, ay, alpha]] = [arm(now.poses[body], point), now.accelerations[body]];
  const square = now.rates[body][2] ** 2;
  return [ax - alpha * dy - square * dx, ay + alpha * dx - square * dy];
}

/** A s: the global components of a vector of a body. */
function arm([, , angle], [a, b]) {
  const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
  return [cos * a - sin * b, sin * a + cos * b];
}

/** Hermite's cubic polynomial through the rows of two frames with the given rates. */
function hermite(rows, rates, body, { low, high, h, share }) {
  const [p, q, u, v] = [rows[low], rows[high], rates[low], rates[high]].map((all) => all[body].map(known));
  return p.map((_, k) => cubic([p[k], q[k]], [u[k], v[k]], h, share));
}

function cubic([p, q], [u, v], h, s) {
  if (s === 0) return p;
  if (s === 1) return q;
  const r = 1 - s;
  return r * r * (1 + 2 * s) * p + s * s * (1 + 2 * r) * q + h * r * s * (r * u - s * v);
}

function linear(values, which, { low, high, share }) {
  const [a, b] = [values[low][which], values[high][which]];
  return a.map((_, k) => known(a[k]) * (1 - share) + known(b[k]) * share);
}

/** A number that was not finite is null in a scene. */
export function known(value) {
  return value === null ? NaN : value;
}
