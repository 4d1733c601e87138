// The instant of the diagrams: the output of the run that is nearest to the shown time.
import { computed, effect, signal, untracked } from "@preact/signals";
import type { Instant, Triple } from "../core/protocol";
import { type Course, course, quantities, show, time, valuesOf } from "../modes/read";
import { nearest } from "../plane/instants";
import type { Point } from "../plane/points";
import { diagram, ofBody, withBody } from "../store/diagram";
import { report, send } from "../store/session";
import { mechanism, mode } from "../store/state";
import { centresOf, centrode } from "./centres";
import { freeBodyOf } from "./freeBody";
import { polygonOf } from "./polygons";

export const instant = signal<Instant | null>(null);

const bodies = computed(() => mechanism.value?.bodies ?? []);
const points = computed(() => bodies.value.map((body) => Object.values(body.points)));

/** The number of a body by its name; null if there is none. */
function numbered(name: string): number | null {
  const found = bodies.value.findIndex((body) => body.name === name);
  return found < 0 ? null : found;
}

/** The number of the body of a free-body diagram. */
export const freeNumber = computed(() => numbered(ofBody.value) || 1);

/** Pairs of more bodies are shown for one body only. */
const MOST_PAIRED = 8;
/** The body from which centres are seen; null for all pairs. */
export const from = computed(() => numbered(ofBody.value) ?? (bodies.value.length > MOST_PAIRED ? 0 : null));

export const centres = computed(() =>
  instant.value && diagram.value === "centres" ? centresOf(instant.value, points.value, from.value) : [],
);
export const polygon = computed(() => {
  const kind = diagram.value;
  return instant.value && (kind === "velocity" || kind === "acceleration")
    ? polygonOf(kind, instant.value, bodies.value)
    : null;
});
export const freeBody = computed(() =>
  instant.value && diagram.value === "body" ? freeBodyOf(instant.value, freeNumber.value) : null,
);

/** The unit of rates of lengths in the run, such as m/s or, over an angle, m/rad. */
export function unitOf(ends: ".vx" | ".ax"): string {
  return quantities.value.find(({ name }) => name.endsWith(ends))?.unit ?? (ends === ".vx" ? "m/s" : "m/s²");
}

/** Everything at an output of the run. */
export async function instantAt({ t, backwards }: Course, k: number): Promise<Instant> {
  return (await send("instant", { at: backwards ? t.length - 1 - k : k })).ok;
}

/** Fetch the instant again where the time or the run has changed; of several changes, the last. */
let fetching = false;
let wanted: { run: Course; k: number } | null = null;

effect(() => {
  const run = course.value;
  if (diagram.value === "none" || mode.value !== "read" || !run?.t.length) {
    wanted = null;
    instant.value = null;
    return;
  }
  wanted = { run, k: nearest(run.t, time.value) };
  if (!fetching) void fetch().catch(report);
});

async function fetch(): Promise<void> {
  fetching = true;
  try {
    while (wanted) {
      const { run, k } = wanted;
      wanted = null;
      const found = await instantAt(run, k);
      if (course.peek() === run && diagram.peek() !== "none") instant.value = found;
    }
  } finally {
    fetching = false;
  }
}

/** With a diagram, the mechanism is drawn at an output, so that both have the same instant. */
effect(() => {
  diagram.value;
  untracked(() => show(time.value));
});

/** The centrodes of the chosen pair in the frames of its bodies. */
export interface Centrodes {
  pair: [number, number];
  lines: [(Point | null)[], (Point | null)[]];
}
export const centrodes = signal<Centrodes | null>(null);

effect(() => {
  const run = course.value;
  const [i, j] = [from.value ?? 0, numbered(withBody.value)];
  centrodes.value = null;
  if (diagram.value !== "centres" || !run || j === null || i === j) return;
  void untracked(() => motionOf(run))
    .then((motion) => {
      const on = (body: number) => centrode(motion, points.value, [i, j], body);
      if (course.peek() === run) centrodes.value = { pair: [i, j], lines: [on(i), on(j)] };
    })
    .catch(report);
});

/** Poses and rates of all bodies at all outputs. */
async function motionOf(run: Course): Promise<Pick<Instant, "bodies">[]> {
  const known = new Set(quantities.value.map(({ name }) => name));
  const of = bodies.value
    .slice(1)
    .flatMap(({ name }) => ["x", "y", "angle", "vx", "vy", "omega"].map((x) => `${name}.${x}`));
  const names = of.filter((name) => known.has(name));
  const { rows } = await valuesOf(names);
  const rowOf = new Map(names.map((name, k) => [name, rows[k]!]));
  const still = { acceleration: null, mass: 0, inertia: 0, turns: true, center: [0, 0] as Point };
  return Array.from(run.t, (_, k) => ({
    bodies: bodies.value.map(({ name }) => {
      const three = (of: string[]) => of.map((x) => rowOf.get(`${name}.${x}`)?.[k] ?? 0) as Triple;
      return { ...still, pose: three(["x", "y", "angle"]), rate: three(["vx", "vy", "omega"]) };
    }),
  }));
}

/** All diagrams at an output, or the shown one, in SI units, for `window.kempe`. */
export async function diagrams(output?: number): Promise<object | null> {
  const run = course.value;
  if (!run) return null;
  const at = await instantAt(run, output ?? nearest(run.t, time.value));
  const plain = (kind: "velocity" | "acceleration") => {
    const { images, sides } = polygonOf(kind, at, bodies.value);
    return { images: Object.fromEntries(images), sides };
  };
  const free = bodies.value.map(({ name }, b) => [name, freeBodyOf(at, b)]);
  return {
    t: at.t,
    centres: centresOf(at, points.value, null),
    velocity: plain("velocity"),
    acceleration: plain("acceleration"),
    free: Object.fromEntries(free),
  };
}
