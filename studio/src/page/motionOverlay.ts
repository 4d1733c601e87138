// What a run adds to the drawing: traces of points, arrows of forces and velocities.
import { computed, effect, signal } from "@preact/signals";
import type { ArrowKind, Vectors } from "../draw/arrows";
import { Trace } from "../draw/traces";
import { type Course, course, quantities, time, valuesOf } from "../modes/read";
import { points } from "../modes/seen";
import { placeIn } from "../plane/instants";
import { distinctPaths, type Path } from "../plane/paths";
import { type Point, placed } from "../plane/points";
import { report } from "../store/session";
import { mechanism, mode, poses, scene } from "../store/state";
import { texts } from "../texts";

/** Kinds of arrows: the endings of the names of their two components. */
export const KINDS = {
  reactions: ["fx", "fy"],
  velocities: ["vx", "vy"],
  accelerations: ["ax", "ay"],
} as const satisfies Record<ArrowKind, unknown>;
export type Kind = ArrowKind;
export const arrows = signal<Record<Kind, boolean>>({ reactions: false, velocities: false, accelerations: false });

interface Fetched {
  kind: Kind;
  unit: string;
  largest: number;
  names: string[];
  rows: Float64Array[];
}

const fetched = signal<Fetched[]>([]);

/** The paths over a run that are drawn; their points are those with arrows. */
const paths = computed(() => {
  const found = course.value;
  if (!found) return [];
  const bodies = (mechanism.value?.bodies ?? []).map((body, number) => ({ ...body, number }));
  const all = bodies.flatMap(({ name, ground, number, points: own }) =>
    ground ? [] : Object.entries(own).map(([point, at]) => pathOf(found, `${name}.${point}`, number, at)),
  );
  return distinctPaths(all);
});

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
  const [x, y] = KINDS[kind];
  const stems = all
    .filter((name) => name.endsWith(`.${x}`) && all.includes(`${name.slice(0, -2)}${y}`))
    .map((name) => name.slice(0, -3));
  const shown = kind === "reactions" ? joints().map(({ name }) => name) : paths.value.map(({ name }) => name);
  const places = new Set(shown);
  const names = stems.filter((stem) => places.has(stem));
  if (!names.length) return null;
  const { units, rows } = await valuesOf(names.flatMap((name) => [`${name}.${x}`, `${name}.${y}`]));
  let largest = 0;
  names.forEach((_, k) => {
    const [u, v] = [rows[2 * k]!, rows[2 * k + 1]!];
    u.forEach((one, n) => {
      const size = Math.hypot(one, v[n]!);
      if (size > largest) largest = size;
    });
  });
  return { kind, unit: units[0] ?? "", largest, names, rows };
}

type Place = Pick<Vectors["vectors"][number], "element" | "owner" | "at">;

/** Where the things with arrows are: points, and joints at a point of their body j. */
function where(): Place[] {
  const named = points().map(({ body, point, at }): Place => {
    const element = `${body.name}.${point}`;
    return { element, owner: element, at };
  });
  const bodies = mechanism.value?.bodies ?? [];
  const places = joints().map(({ name, bodies: [, j], points: [, at] }): Place => {
    const pose = poses.value[j];
    const owner = texts.read.on(bodies[j]?.name ?? "");
    return { element: name, owner, at: pose ? placed(pose, at) : at };
  });
  return bodies.length ? [...named, ...places] : [];
}

interface Joint {
  name: string;
  bodies: [number, number];
  points: [Point, Point];
}

function joints(): Joint[] {
  return (scene.value as { joints?: Joint[] } | null)?.joints ?? [];
}

/** Vectors, and the largest of their kind over the run. */
export interface Shown extends Omit<Vectors, "pixels"> {
  largest: number;
}

export const vectors = computed<Shown[]>(() => {
  const run = course.value;
  if (!run || mode.value !== "read") return [];
  const { low, high, share } = placeIn(run.t, time.value);
  const places = new Map(where().map((place) => [place.element, place]));
  return fetched.value.map(({ kind, unit, largest, names, rows }) => {
    const at = (row: Float64Array) => row[low]! + share * (row[high]! - row[low]!);
    const found = names.flatMap((name, k) => {
      const place = places.get(name);
      const value: Point = [at(rows[2 * k]!), at(rows[2 * k + 1]!)];
      return place ? [{ ...place, value }] : [];
    });
    return { kind, unit, largest, vectors: found };
  });
});
