// The forces, velocities and accelerations that a drawing can show as arrows.
import { acceleration, velocity } from "./motion.js";
import { shortened } from "./numbers.js";
import { extent } from "./view.js";

/** Share of the drawing that the largest velocity and the largest acceleration take. */
const LONGEST = 0.22;

/** The vectors that can be drawn at an instant, and how long one unit of each kind is, m. */
export class Vectors {
  constructor(scene) {
    this.scene = scene;
    this.points = tracked(scene);
    const size = LONGEST * extent(scene.bounds);
    const kind = (unit, vector, largest) => ({ unit, vector, length: largest > 0 ? size / largest : 0 });
    const { force, length } = scene.reaction_scale;
    this.kinds = {
      reactions: { unit: "N", length: length / force },
      velocities: kind("m/s", velocity, scene.largest.velocity),
      accelerations: kind("m/s²", acceleration, scene.largest.acceleration),
    };
  }

  /** Those of a kind: the force of each joint on its body j, or of each tracked point. */
  of(kind, now) {
    if (kind === "reactions") {
      return this.scene.joints.map(({ name, bodies, points }, k) => {
        const body = this.scene.bodies[bodies[1]].name;
        return { element: name, owner: `on ${shortened(body, 16)}`, body: bodies[1], at: points[1], value: now.forces[k] };
      });
    }
    const { vector } = this.kinds[kind];
    return this.points.map(({ name, body, at }) => ({ element: name, owner: shortened(name, 20), body, at, value: vector(now, body, at) }));
  }
}

/** The traced points, and the mass centre of each body without one. */
function tracked({ bodies, traces }) {
  const points = traces.map(({ name, body, point }) => ({ name, body, at: point }));
  const others = bodies.filter(({ number, points: named }) => number > 0 && !named.length);
  return [...points, ...others.map(({ name, number, center }) => ({ name, body: number, at: center }))];
}
