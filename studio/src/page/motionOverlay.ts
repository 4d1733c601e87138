// Traces of points, and arrows of forces, velocities and accelerations, which a run adds to the drawing.
import { computed, effect, signal, untracked } from "@preact/signals";
import type { Group } from "../catalogue/catalogue";
import type { ArrowKind, Vectors } from "../draw/arrows";
import { displayed } from "../draw/display";
import { ACTING } from "../draw/ends";
import { Trace } from "../draw/traces";
import { type Course, condition, course, found, quantities, starred, time, valuesOf } from "../modes/read";
import { points } from "../modes/seen";
import { placeIn } from "../plane/instants";
import { distinctPaths, type Path } from "../plane/paths";
import { type Point, placed } from "../plane/points";
import { report } from "../store/session";
import { fitWith, view } from "../store/sheet";
import { mechanism, mode, units } from "../store/state";
import { texts } from "../texts";
import { endsOf } from "./acting";

/** Each kind of arrow: the last parts of the names of its two components, and the groups of its elements. */
export const KINDS = {
  reactions: { ends: ["fx", "fy"], groups: ACTING.reactions },
  force: { ends: ["fx", "fy"], groups: ACTING.force },
  velocities: { ends: ["vx", "vy"], groups: [] },
  accelerations: { ends: ["ax", "ay"], groups: [] },
} as const satisfies Record<ArrowKind, { ends: [string, string]; groups: readonly Group[] }>;
export type Kind = ArrowKind;
export const arrows = signal<Record<Kind, boolean>>({
  reactions: false,
  force: false,
  velocities: false,
  accelerations: false,
});
/** The name of the body whose arrows are shown; empty for those of all bodies. */
export const onBody = signal("");

/** The number of that body; null for all bodies, and if the case has no body of this name any more. */
const only = computed(() => {
  const found = mechanism.value?.bodies.findIndex(({ name }) => name === onBody.value) ?? -1;
  return found < 0 ? null : found;
});

interface Fetched {
  kind: Kind;
  unit: string;
  largest: number;
  names: string[];
  rows: Float64Array[];
}

const fetched = signal<Fetched[]>([]);

/** The paths of all points over a run. */
const all = computed(() => {
  const found = course.value;
  if (!found) return [];
  const bodies = (mechanism.value?.bodies ?? []).map((body, number) => ({ ...body, number }));
  return bodies.flatMap(({ name, ground, number, points: own }) =>
    ground ? [] : Object.entries(own).map(([point, at]) => pathOf(found, `${name}.${point}`, number, at)),
  );
});

/** The paths that are drawn. */
const paths = computed(() => distinctPaths(all.value));

/** Show the paths of a new run, unless the user has chosen the view. */
effect(() => {
  const places = paths.value.flatMap(({ line }) => line);
  if (places.length && !view.moved) untracked(() => fitWith(places));
});

/**
 * The paths whose points have arrows. Of points that are pinned together, one has an arrow. If a body is
 * chosen, its own points have arrows.
 */
const tracked = computed(() =>
  only.value === null ? paths.value : distinctPaths(all.value.filter(({ body }) => body === only.value)),
);

function pathOf({ t, rows, width }: Course, name: string, body: number, point: Point): Path {
  const line = Array.from(t, (_, k): Point => {
    const at = k * width + 1 + 3 * (body - 1);
    return placed([rows[at]!, rows[at + 1]!, rows[at + 2]!], point);
  });
  return { name, body, line };
}

export const traces = computed(() => {
  if (mode.value !== "read") return [];
  return paths.value.map(({ body, line }) => new Trace(body, line));
});

/** The outlines of areas that a result contains, m. */
export const outlines = computed(() => (mode.value === "read" ? (found.value?.outlines ?? []) : []));

/** Fetch the components of the arrows that are shown, once for each run. */
effect(() => {
  const run = course.value;
  const wanted = (Object.keys(KINDS) as Kind[]).filter((kind) => arrows.value[kind]);
  if (!run || !wanted.length) {
    fetched.value = [];
    return;
  }
  void Promise.all(
    wanted.map((kind) =>
      fetchKind(
        kind,
        quantities.value.map(({ name }) => name),
      ),
    ),
  )
    .then((all) => {
      fetched.value = all.filter((one) => one !== null);
    })
    .catch(report);
});

async function fetchKind(kind: Kind, all: string[]): Promise<Fetched | null> {
  const {
    ends: [x, y],
    groups,
  } = KINDS[kind];
  const stems = all
    .filter((name) => name.endsWith(`.${x}`) && all.includes(`${name.slice(0, -2)}${y}`))
    .map((name) => name.slice(0, -3));
  const elements = groups.flatMap((group) => (mechanism.value?.[group] ?? []).map(({ name }) => name));
  const places = new Set(groups.length ? elements : tracked.value.map(({ name }) => name));
  const names = stems.filter((stem) => places.has(stem));
  if (!names.length) return null;
  const { units: unitsOf, rows } = await valuesOf(names.flatMap((name) => [`${name}.${x}`, `${name}.${y}`]));
  let largest = 0;
  names.forEach((_, k) => {
    const [u, v] = [rows[2 * k]!, rows[2 * k + 1]!];
    u.forEach((one, n) => {
      const size = Math.hypot(one, v[n]!);
      if (size > largest) largest = size;
    });
  });
  return { kind, unit: unitsOf[0] ?? "", largest, names, rows };
}

type Place = Pick<Vectors["vectors"][number], "element" | "owner" | "at"> & { sign: 1 | -1 };

/** The places of the arrows of a kind: the ends of elements for forces, otherwise the points of bodies. */
function where({ groups }: (typeof KINDS)[Kind]): Place[] {
  const bodies = mechanism.value?.bodies ?? [];
  if (groups.length)
    return endsOf(groups, only.value).map((end) => ({
      ...end,
      owner: starred(texts.read.on(bodies[end.body]?.name ?? ""), end.element),
    }));
  return points().map(({ body, point, at }): Place => {
    const element = `${body.name}.${point}`;
    return { element, owner: element, at, sign: 1 };
  });
}

/** Vectors, and the largest of their kind over the run. */
export interface Shown extends Omit<Vectors, "pixels"> {
  largest: number;
}

export const vectors = computed<Shown[]>(() => {
  const run = course.value;
  if (!run || mode.value !== "read") return [];
  const { low, high, share } = placeIn(run.t, time.value);
  return fetched.value.map(({ kind, unit: base, largest, names, rows }) => {
    const { factor, unit } = displayed(base, units.value);
    const at = (row: Float64Array) => factor * (row[low]! + share * (row[high]! - row[low]!));
    const rowOf = new Map(names.map((name, k) => [name, 2 * k]));
    const found = where(KINDS[kind]).flatMap(({ sign, ...place }) => {
      const k = rowOf.get(place.element);
      if (k === undefined) return [];
      const value: Point = [sign * at(rows[k]!), sign * at(rows[k + 1]!)];
      return [{ ...place, value }];
    });
    return { kind, unit, largest: factor * largest, vectors: found };
  });
});

/** The line beside the arrows of forces: over a quantity, it says what they contain. */
export const notes = computed(() => {
  const acting = vectors.value.some(({ kind }) => KINDS[kind].groups.length > 0);
  return acting && condition.value ? [texts.read.forces(condition.value)] : [];
});
