// The motion of the scene: where everything is at any time. Knows no screen.

/** A motion over the frames of a scene. */
export class Motion {
  constructor(scene) {
    this.scene = scene;
    this.t = scene.frames.t;
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
    return { low, high, h, share: h > 0 ? (t - this.t[low]) / h : 0 };
  }

  /** The frame nearest to t. */
  nearest(t) {
    const { low, high, share } = this.place(t);
    return share < 0.5 ? low : high;
  }

  /** Everything at t: pose of each body, ground first, and the reaction of each joint. */
  at(t) {
    const place = this.place(t);
    if (!this.smooth) place.share = Math.round(place.share);
    const { poses, rates, reactions } = this.scene.frames;
    const moving = poses[place.low].map((_, body) => hermite(poses, rates, body, place));
    const forces = reactions[place.low].map((_, joint) => linear(reactions, joint, place));
    return { t, poses: [[0, 0, 0], ...moving], forces };
  }

  /** Value of a channel at t. */
  value(channel, t) {
    const { low, high, share } = this.place(t);
    const [a, b] = [channel.values[low], channel.values[high]];
    if (a === null || b === null) return NaN;
    return a + (b - a) * (this.smooth ? share : Math.round(share));
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

/** Hermite's cubic polynomial through poses and rates of two frames. */
function hermite(poses, rates, body, { low, high, h, share: s }) {
  const [p, q, u, v] = [poses[low], poses[high], rates[low], rates[high]].map((all) => all[body]);
  if (s === 0) return p.map(known);
  if (s === 1) return q.map(known);
  const r = 1 - s;
  const [a, b] = [r * r * (1 + 2 * s), s * s * (1 + 2 * r)];
  return p.map((_, k) => a * known(p[k]) + b * known(q[k]) + h * r * s * (r * known(u[k]) - s * known(v[k])));
}

function linear(values, which, { low, high, share }) {
  const [a, b] = [values[low][which], values[high][which]];
  return a.map((_, k) => known(a[k]) * (1 - share) + known(b[k]) * share);
}

/** A number that was not finite is null in a scene. */
function known(value) {
  return value === null ? NaN : value;
}
