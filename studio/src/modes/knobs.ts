// How the numbers of the text move a place of the drawing: the core tries each of them.
import type { Body, Change, Loaded } from "../core/protocol";
import { moved } from "../edit/moving";
import { type Numeral, numeralsAt, withValues } from "../edit/numerals";
import type { PointHit } from "../plane/hits";
import { type Placement, type Point, placed } from "../plane/points";
import { send } from "../store/session";
import { loads, mechanism, poses, scene, text, tree, unassembled } from "../store/state";

/** A number that a drag changes, and the velocity of the place by this number. */
export interface Knob {
  label: string;
  value: number;
  column: Point;
  /** The number in the text; null for a coordinate of all points at the place, which are plain numbers. */
  numeral: Numeral | null;
}

/** A place of the drawing before a drag: what the drag may change. */
export interface Grasp {
  hits: PointHit[];
  at: Point;
  placements: readonly Placement[];
  tree: typeof tree.value;
  /** All numbers that move the place, the most natural ones first. */
  knobs: Knob[];
}

/** Numbers that are tried at most. */
const MOST = 14;
/** The change of a number in a trial, relative to it or to the size of the drawing. */
const TRIAL = 2e-3;
/** A number moves the place if a change by its own size moves it by this share of the drawing. */
const LEAST = 1e-3;
/** A coordinate moves its place with this relative accuracy. */
const SAME = 0.02;
/** Texts with more letters are not tried, because it would take too long. */
const LONGEST = 200_000;

/** The place of the first point of a grasp; another geometry may have moved it in its body. */
export function placeOf(
  { hits: [hit] }: Pick<Grasp, "hits">,
  bodies: readonly Body[] = mechanism.value?.bodies ?? [],
  all: readonly Placement[] = poses.value,
): Point | null {
  const k = bodies.findIndex(({ name }) => name === hit?.body.name);
  const [pose, point] = [all[k], bodies[k]?.points[hit?.point ?? ""]];
  return pose && point ? placed(pose, point) : null;
}

/** The changes that give some numbers of a grasp other values. */
export function changesFor(
  { hits, at, placements, tree: before }: Grasp,
  knobs: readonly Knob[],
  values: readonly number[],
): Change[] {
  const numerals = knobs.flatMap((one, k) => (one.numeral ? [{ one: one.numeral, value: values[k]! }] : []));
  const to: Point = [...at];
  knobs.forEach((one, k) => {
    if (!one.numeral) to[one.column[0] ? 0 : 1] = values[k]!;
  });
  const bodies = mechanism.value?.bodies ?? [];
  const plain = knobs.some(({ numeral }) => !numeral) ? moved(before, hits, placements, bodies, to).changes : [];
  return [
    ...plain,
    ...withValues(
      before,
      numerals.map(({ one }) => one),
      numerals.map(({ value }) => value),
    ),
  ];
}

function size(): number {
  const [x0, y0, x1, y1] = scene.value?.bounds ?? [0, 0, 1, 1];
  return Math.max(x1 - x0, y1 - y0) || 1;
}

let known: { key: string; found: Promise<Grasp | null> } | null = null;

/** What a drag of points at one place may change; null if the text changed meanwhile. Equal questions are asked once. */
export function graspOf(hits: PointHit[], at: Point): Promise<Grasp | null> {
  const key = [loads.value, ...hits.map(({ body, point }) => `${body.name}.${point}`)].join(" ");
  if (known?.key !== key) known = { key, found: tried(hits, at) };
  return known.found;
}

async function tried(hits: PointHit[], at: Point): Promise<Grasp | null> {
  const grasp: Grasp = { hits, at, placements: poses.value, tree: tree.value, knobs: [] };
  const before = text.value;
  if (unassembled.value || before.length > LONGEST) return grasp;
  const length = size();
  const axes: Knob[] = [0, 1].map((k) => ({
    label: labelOf(hits),
    value: at[k]!,
    column: k ? [0, 1] : [1, 0],
    numeral: null,
  }));
  const numbers = numeralsAt(tree.value, hits).map((numeral): Knob => ({ ...numeral, column: [0, 0], numeral }));
  const all = [...axes, ...numbers].slice(0, MOST);
  const steps = all.map(({ value, numeral }) => TRIAL * (numeral && value ? Math.abs(value) : length));
  const written = await Promise.all(
    all.map((one, k) => {
      const changes = changesFor(grasp, [one], [one.value + steps[k]!]);
      return changes.length
        ? send("edit", { changes }).then(
            ({ ok }) => ok.text,
            () => null,
          )
        : null;
    }),
  );
  if (text.value !== before) return null;
  // no other request comes between the trials and the text itself
  const trials = written.map((one) => (one === null ? null : send("load", { text: one })));
  const back = send("load", { text: before });
  const results = await Promise.all(
    trials.map(
      (one) =>
        one?.then(
          ({ ok }) => ok,
          () => null,
        ) ?? null,
    ),
  );
  await back;
  const columns = results.map((one, k) => columnOf(one, grasp, steps[k]!));
  grasp.knobs = all.flatMap((one, k) => {
    const column = columns[k];
    if (!column) return [];
    if (!one.numeral) return Math.hypot(column[0] - one.column[0], column[1] - one.column[1]) < SAME ? [one] : [];
    const most = one.value ? Math.abs(one.value) : length;
    return Math.hypot(...column) * most > LEAST * length ? [{ ...one, column }] : [];
  });
  if (grasp.knobs.filter(({ numeral }) => !numeral).length === 1)
    grasp.knobs = grasp.knobs.filter(({ numeral }) => numeral);
  return grasp;
}

function labelOf(hits: readonly PointHit[]): string {
  return hits[0] ? `${hits[0].body.name}.${hits[0].point}` : "";
}

function columnOf(found: Loaded | null, grasp: Grasp, step: number): Point | null {
  if (!found?.pose || found.unassembled || found.problems.length) return null;
  const place = placeOf(grasp, found.mechanism?.bodies ?? [], [[0, 0, 0], ...found.pose.poses]);
  return place && [(place[0] - grasp.at[0]) / step, (place[1] - grasp.at[1]) / step];
}

/** The sine of the smallest angle between two columns that together move a place in both directions. */
const SPREAD = 0.1;

function cross(a: Point, b: Point): number {
  return (a[0] * b[1] - a[1] * b[0]) / (Math.hypot(...a) * Math.hypot(...b));
}

/** The numbers that a drag changes: the first, and the first other one that moves the place across. */
export function naturalOf({ knobs: [first, ...others] }: Grasp): Knob[] {
  const second = first && others.find(({ column }) => Math.abs(cross(first.column, column)) > SPREAD);
  return first ? [first, ...(second ? [second] : [])] : [];
}

/** Other choices beside those that a drag has changed. */
export function otherWays(grasp: Grasp, taken: readonly Knob[]): Knob[][] {
  const single = grasp.knobs.filter(({ numeral }) => numeral).map((one) => [one]);
  const natural = naturalOf(grasp);
  const same = (way: Knob[]) => way.length === taken.length && way.every((one) => taken.includes(one));
  return [natural, ...(natural.length > 1 || natural[0] !== single[0]?.[0] ? single : single.slice(1))].filter(
    (way) => !same(way),
  );
}

export function nameOf(knobs: readonly Knob[]): string {
  return [...new Set(knobs.map(({ label }) => label))].join(", ");
}
