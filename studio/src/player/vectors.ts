// The forces, velocities and accelerations that the drawing can show as arrows.
import type { ArrowKind, Vector } from "../draw/arrows";
import { shortened } from "../draw/numbers";
import { type Point, placed } from "../plane/points";
import { extent } from "../plane/view";
import { playerTexts as texts } from "../texts";
import { acceleration, type Instant, velocity } from "./motion";
import type { Scene } from "./scene";

/** Share of the drawing that the largest velocity and the largest acceleration take. */
const LONGEST = 0.22;
const UNITS: Record<ArrowKind, string> = { reactions: "N", velocities: "m/s", accelerations: "m/s²" };

interface Tracked {
  name: string;
  body: number;
  at: Point;
}

/** How long one unit of each kind is drawn, m. */
function lengths({ bounds, reaction_scale: { force, length }, largest }: Scene): Record<ArrowKind, number> {
  const share = (value: number) => (value > 0 ? (LONGEST * extent(bounds)) / value : 0);
  return {
    reactions: length / force,
    velocities: share(largest.velocity),
    accelerations: share(largest.acceleration),
  };
}

/** The vectors that can be drawn at an instant. */
export class SceneVectors {
  private readonly tracked: Tracked[];
  private readonly lengths: Record<ArrowKind, number>;

  constructor(private readonly scene: Scene) {
    this.tracked = tracked(scene);
    this.lengths = lengths(scene);
  }

  unit(kind: ArrowKind): string {
    return UNITS[kind];
  }

  /** How long one unit is drawn, m. */
  length(kind: ArrowKind): number {
    return this.lengths[kind];
  }

  /** Those of a kind: the force of each joint on its body j, or of each tracked point. */
  of(kind: ArrowKind, now: Instant): Vector[] {
    if (kind === "reactions") return this.reactions(now);
    const vector = kind === "velocities" ? velocity : acceleration;
    return this.tracked.map(({ name, body, at }) => ({
      element: name,
      owner: shortened(name, 20),
      at: placed(now.poses[body]!, at),
      value: vector(now, body, at),
    }));
  }

  private reactions(now: Instant): Vector[] {
    return this.scene.joints.map(({ name, bodies: [, j], points: [, at] }, k) => ({
      element: name,
      owner: texts.on(shortened(this.scene.bodies[j]!.name, 16)),
      at: placed(now.poses[j]!, at),
      value: now.forces[k]!,
    }));
  }
}

/** The traced points, and the mass centre of each body without one. */
function tracked({ bodies, traces }: Scene): Tracked[] {
  const points = traces.map(({ name, body, point }) => ({ name, body, at: point }));
  const others = bodies.filter(({ number, points: named }) => number > 0 && !named.length);
  return [...points, ...others.map(({ name, number, center }) => ({ name, body: number, at: center }))];
}
