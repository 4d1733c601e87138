// The steps of the first build: their actions, the conditions that end them, and their marks on the sheet.
import { isPin } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { entries } from "../catalogue/tree";
import { snapStep } from "../draw/measure";
import { points } from "../modes/seen";
import { distance, type Point } from "../plane/points";
import { view, viewed } from "../store/sheet";
import { catalogue, home, live, type Mode, mechanism, mode, pose, tree } from "../store/state";

/** The places to click, in order, and the line between them. */
export interface Ghost {
  at: Point[];
  line: Point[];
}

export interface Step {
  name: "ground" | "crank" | "coupler" | "rocker" | "driver" | "move" | "live" | "read";
  mode: Mode;
  /** Whether the step uses this tool of the palette. */
  tool?: (one: Tool) => boolean;
  done(): boolean;
  ghost(): Ghost;
}

const NOTHING: Ghost = { at: [], line: [] };
/** The line between the suggested fixed points: its length and distance below the middle, as shares of the sheet. */
const LENGTH = [0.45, 0.45] as const;
const BELOW = 0.14;
/** Ends of crank and coupler, as shares of the line between the fixed points: a crank-rocker. */
const CRANK_END: Point = [0.15, 0.25];
const COUPLER_END: Point = [0.85, 0.8];
/** The mechanism has been moved if a coordinate has changed by this, rad or m. */
const MOVED = 0.1;
/** The step with the motion ends after these seconds. */
const SEEN = 1;

const fixes = ({ placing }: Tool) => placing === "fixed";
const joinsTwo = ({ placing }: Tool) => placing === "two";
const drives = ({ group, references }: Tool) =>
  group === "drivers" && references.length === 1 && references[0]!.shape === "coordinate";

export const STEPS: Step[] = [
  { name: "ground", mode: "edit", tool: fixes, done: () => fixed().length > 1, ghost: ghostOfGround },
  { name: "crank", mode: "edit", tool: joinsTwo, done: () => has(1, 1), ghost: () => lineTo(0, 1) },
  { name: "coupler", mode: "edit", tool: joinsTwo, done: () => has(2, 2), ghost: () => lineTo(1, 2) },
  { name: "rocker", mode: "edit", tool: joinsTwo, done: () => has(3, 4), ghost: () => lineTo(2, 3) },
  { name: "driver", mode: "edit", tool: drives, done: () => drivers() > 0, ghost: ghostOfCrank },
  { name: "move", mode: "move", done: hasMoved, ghost: ghostOfDrag },
  { name: "live", mode: "live", done: () => (live.value?.t ?? 0) - (home.value?.t ?? 0) > SEEN, ghost: () => NOTHING },
  { name: "read", mode: "read", done: () => false, ghost: () => NOTHING },
];

function fixed(): Point[] {
  const ground = mechanism.value?.bodies.find((body) => body.ground);
  return Object.values(ground?.points ?? {});
}

function drivers(): number {
  return mechanism.value?.drivers.length ?? 0;
}

/** Whether there are at least these numbers of moving bodies and pins. */
function has(bodies: number, pins: number): boolean {
  const names = new Set(catalogue.value.joints.filter(isPin).map(({ name }) => name));
  const found = Object.values(entries(tree.value, "joints")).filter(({ type }) => names.has(String(type)));
  return (mechanism.value?.bodies.length ?? 1) > bodies && found.length >= pins;
}

/** Whether the pose differs from that of the text. */
function hasMoved(): boolean {
  const [now, before] = [pose.value?.poses, home.value?.poses];
  return mode.value === "move" && !!now?.some((one, k) => one.some((x, n) => Math.abs(x - before![k]![n]!) > MOVED));
}

/** The pins of the linkage, and suggested positions for missing ones. */
function pins(): Point[] {
  const found = fixed();
  const [crank, coupler] = (mechanism.value?.bodies ?? []).filter((body) => !body.ground);
  const ends = (name?: string) => points().filter(({ body }) => body.name === name);
  const near = (a: Point, b: Point) => distance(a, b) < 1e-6;
  const start = found.find((at) => ends(crank?.name).some((end) => near(end.at, at))) ?? found[0];
  const other = found.find((at) => at !== start);
  if (!start || !other) return [];
  const far = (name: string | undefined, from: Point) => ends(name).find(({ at }) => !near(at, from))?.at;
  const b = far(crank?.name, start) ?? between(start, other, CRANK_END);
  const c = far(coupler?.name, b) ?? between(start, other, COUPLER_END);
  return [start, b, c, other];
}

/** A place given by shares of the vector from one point to another and of the vector to its left. */
function between([ax, ay]: Point, [bx, by]: Point, [along, across]: Point): Point {
  const [dx, dy] = [bx - ax, by - ay];
  const side = dx < 0 ? -across : across; // above the line
  return [ax + along * dx - side * dy, ay + along * dy + side * dx];
}

function lineTo(begin: number, end: number): Ghost {
  const all = pins();
  if (!all.length) return NOTHING;
  const line = [all[begin]!, all[end]!];
  return { at: line, line };
}

function ghostOfGround(): Ghost {
  viewed.value;
  const step = snapStep(view);
  const [middle, y] = view
    .toPlane([view.width / 2, (0.5 + BELOW) * view.height])
    .map((x) => Math.round(x / step) * step);
  const half = Math.round(Math.min(LENGTH[0] * view.width, LENGTH[1] * view.height) / view.scale / step / 2) * step;
  const suggested: Point[] = [
    [middle! - half, y!],
    [middle! + half, y!],
  ];
  const [first] = fixed();
  if (!first) return { at: suggested, line: [] };
  const far = suggested.sort((a, b) => distance(b, first) - distance(a, first));
  return { at: [far[0]!], line: [] };
}

function ghostOfCrank(): Ghost {
  const [a, b] = pins();
  return a && b ? { at: [[(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]], line: [] } : NOTHING;
}

/** Points on an arc that starts at the end of the crank. */
function ghostOfDrag(): Ghost {
  const [a, b] = pins();
  if (!a || !b) return NOTHING;
  const arc = [0, 0.25, 0.5, 0.75, 1].map((angle): Point => {
    const [cos, sin] = [Math.cos(angle), Math.sin(angle)];
    const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    return [a[0] + cos * dx - sin * dy, a[1] + sin * dx + cos * dy];
  });
  return { at: [b], line: arc };
}
