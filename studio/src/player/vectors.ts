// The forces, velocities and accelerations that the drawing can show as arrows.
import type { ArrowKind, Vector } from "../draw/arrows";
import { shortened } from "../draw/numbers";
import { type Point, placed } from "../plane/points";
import { extent } from "../plane/view";
import { Acting } from "./acting";
import { acceleration, type Instant, velocity } from "./motion";
import type { Scene } from "./scene";

/** Share of the drawing that the largest force, velocity and acceleration take. */
const LONGEST = 0.22;
/** The unit of each kind of arrows, by its key in the scene. */
const UNITS = {
  reactions: "force",
  force: "force",
  velocities: "velocity",
  accelerations: "acceleration",
} as const satisfies Record<ArrowKind, keyof Scene["units"]>;

interface Tracked {
  name: string;
  body: number;
  at: Point;
}

/** The drawn length of one unit of each kind, m. */
function lengths({ bounds, reaction_scale: { force, length }, largest }: Scene): Record<ArrowKind, number> {
  const share = (value: number) => (value > 0 ? (LONGEST * extent(bounds)) / value : 0);
  return {
    reactions: length / force,
    force: share(largest.force),
    velocities: share(largest.velocity),
    accelerations: share(largest.acceleration),
  };
}

/** The vectors that can be drawn at an instant. */
export class SceneVectors {
  private readonly acting: Acting;
  private readonly lengths: Record<ArrowKind, number>;

  constructor(private readonly scene: Scene) {
    this.acting = new Acting(scene);
    this.lengths = lengths(scene);
  }

  unit(kind: ArrowKind): string {
    return this.scene.units[UNITS[kind]];
  }

  /** Lines beside the arrows of some kinds: the reason why they are missing, or remarks on them. */
  notes(kinds: readonly ArrowKind[]): string[] {
    const missing = kinds.some((kind) => kind !== "velocities") ? this.scene.undetermined : "";
    return missing ? [missing] : this.acting.notes(kinds);
  }

  /** The drawn length of one unit, m. */
  length(kind: ArrowKind): number {
    return this.lengths[kind];
  }

  /** Those of a kind, of all bodies or of one: forces at the ends of elements, otherwise of points. */
  of(kind: ArrowKind, now: Instant, on: number | null): Vector[] {
    if (kind === "reactions" || kind === "force") return this.acting.of(kind, now, on);
    const vector = kind === "velocities" ? velocity : acceleration;
    return tracked(this.scene, on).map(({ name, body, at }) => ({
      element: name,
      owner: shortened(name, 20),
      at: placed(now.poses[body]!, at),
      value: vector(now, body, at),
    }));
  }
}

/** The traced points, or all points of one body; the mass centre of each body without points. */
function tracked({ bodies, traces }: Scene, on: number | null): Tracked[] {
  const moving = bodies.filter(({ number }) => number > 0 && (on === null || number === on));
  const own = moving.flatMap(({ name, number, points }) =>
    points.map((point) => ({ name: `${name}.${point.name}`, body: number, at: point.at })),
  );
  const traced = traces.map(({ name, body, point }) => ({ name, body, at: point }));
  const others = moving.filter(({ points }) => !points.length);
  return [
    ...(on === null ? traced : own),
    ...others.map(({ name, number, center }) => ({ name, body: number, at: center })),
  ];
}
