// The forces of elements as arrows: those on body j, or those on one body with the signs for it.
import type { Vector } from "../draw/arrows";
import { ACTING, chosenEnds } from "../draw/ends";
import { shortened } from "../draw/numbers";
import { type Point, placed } from "../plane/points";
import { playerTexts as texts } from "../texts";
import type { Instant } from "./motion";
import type { Scene } from "./scene";

type End = Scene["ends"][number];
/** Signs of remarks, for example on a reaction that is not unique or has no bound. */
const SIGNS = ["*", "†", "‡", "§"];
/** The force of an element on its body j. */
type Force = (now: Instant) => Point;

/** The forces of a scene: joints have theirs in the frames, other elements in the channels. */
export class Acting {
  private readonly forces: Map<string, Force>;
  /** The sign of each remark; further remarks stand beside their arrows. */
  private readonly signs: Map<string, string>;

  constructor(private readonly scene: Scene) {
    const joints = scene.joints.map(({ name }, k) => [name, (now: Instant) => now.forces[k]!] as const);
    this.forces = new Map<string, Force>([...joints, ...ofChannels(scene)]);
    const remarks = new Set(scene.ends.map(({ remark }) => remark).filter((remark) => remark));
    this.signs = new Map([...remarks].slice(0, SIGNS.length).map((remark, k) => [remark, SIGNS[k]!]));
  }

  /** The vectors of a kind at an instant; `on` is the number of a body, or null for bodies j. */
  of(kind: keyof typeof ACTING, now: Instant, on: number | null): Vector[] {
    const groups: readonly string[] = ACTING[kind];
    const ends = this.scene.ends.filter(({ group }) => groups.includes(group));
    return chosenEnds(ends, on).flatMap((end) => {
      const force = this.forces.get(end.element);
      return force ? [this.vector(end, force(now), now)] : [];
    });
  }

  /** Lines below arrows of some kinds: what forces over a quantity contain, and the meaning of each sign. */
  notes(kinds: readonly string[]): string[] {
    const groups: string[] = Object.entries(ACTING).flatMap(([kind, own]) => (kinds.includes(kind) ? [...own] : []));
    const ends = this.scene.ends.filter(({ group }) => groups.includes(group));
    const shown = new Set(ends.map(({ remark }) => remark));
    const signs = [...this.signs].filter(([remark]) => shown.has(remark)).map(([remark, sign]) => `${sign} ${remark}`);
    const { condition } = this.scene.variable;
    return ends.length && condition ? [texts.forces(condition), ...signs] : signs;
  }

  private vector({ element, body, frame, point, sign, remark }: End, [x, y]: Point, now: Instant): Vector {
    const owner = texts.on(shortened(this.scene.bodies[body]!.name, 16));
    return {
      element,
      owner: remark ? `${owner} ${this.signs.get(remark) ?? texts.remarked(remark)}` : owner,
      at: placed(now.poses[frame]!, point),
      value: [sign * x, sign * y],
    };
  }
}

/** The forces of drivers and force elements, linear between frames as those of joints. */
function ofChannels({ channels }: Scene): [string, Force][] {
  const parts = new Map(channels.map(({ of, quantity, values }) => [`${of}.${quantity}`, values]));
  return [...new Set(channels.map(({ of }) => of))].flatMap((of): [string, Force][] => {
    const [x, y] = [parts.get(`${of}.force_x`), parts.get(`${of}.force_y`)];
    if (!x || !y) return [];
    return [[of, ({ place: { low, high, share } }) => [between(x, low, high, share), between(y, low, high, share)]]];
  });
}

function between(values: number[], low: number, high: number, share: number): number {
  return values[low]! * (1 - share) + values[high]! * share;
}
