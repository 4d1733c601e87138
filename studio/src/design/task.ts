// The task of the section [synthesis]: poses of a coupler or points of a path, and the four-bars that the core finds.
import { computed, effect, signal } from "@preact/signals";
import { isTable } from "../catalogue/tree";
import type { Candidate, Change, Solved, Tree, Triple, Value } from "../core/protocol";
import { CoreError, Superseded } from "../core/transport";
import { type Point, rounded } from "../plane/points";
import { change } from "../store/document";
import { report, send } from "../store/session";
import { fitWith } from "../store/sheet";
import { announce, loads, mode, openings, tree, units } from "../store/state";
import { texts } from "../texts";

/** The most poses that a four-bar takes exactly, and the most points. */
const MOST = { poses: 5, points: 9 };
/** Starts of the search for a path before its candidates are shown again. */
const PIECE = 6;
const DEGREES = 180 / Math.PI;

/** The answer of the core to the section; null without one. */
export const solved = signal<Solved | null>(null);
/** The reason why the section cannot be read. */
export const fault = signal<string | null>(null);
/** The number of the shown candidate, from 0. */
export const chosen = signal(0);
/** The number of the selected pose. */
export const active = signal<number | null>(null);

export const section = computed<Tree | null>(() => {
  const found = tree.value?.synthesis;
  return isTable(found) ? found : null;
});
const kind = computed(() => section.value?.task);
/** Whether clicks and drags make points of a path. */
export const draws = signal(false);
/** The list of the section that the pointer changes. */
export const list = computed(() => (draws.value ? "points" : "poses"));
/** The poses, or the points of the path with angles that mean nothing. */
export const poses = computed<Triple[]>(() => {
  const found = solved.value;
  return found ? [...found.poses, ...found.points.map(([x, y]): Triple => [x, y, 0])] : [];
});
/** Whether the entries of the list are shown one by one: those of a path that is drawn by hand are too many. */
export const single = computed(() => poses.value.length <= MOST[list.value]);
export const full = computed(() => poses.value.length >= MOST[list.value]);
/** Whether the search for a path goes on. */
export const searching = signal(false);
/** The number of the candidate under the pointer, which is shown in place of the chosen one. */
export const hovered = signal<number | null>(null);
export const candidate = computed(() => solved.value?.candidates[hovered.value ?? chosen.value] ?? null);
/** The candidate that the bodies of the case are, from 0. */
export const taken = computed<number | null>(() => {
  const found = section.value?.choice;
  return typeof found === "number" ? found - 1 : null;
});

effect(() => {
  loads.value;
  if (mode.value === "design") void solve();
});

/** The opening of the case to which the answer belongs, and that of which the task is known. */
let opened = -1;
let known = -1;

// a case with a task shows it; without one, the choice of the panel stays
effect(() => {
  const of = kind.value;
  if (of || openings.value !== known) draws.value = of === "path";
  known = openings.value;
});

/** Show all poses of a case that was opened. */
function showAll(found: Solved): void {
  active.value = null;
  const at = poses.value.map(([x, y]): Point => [x, y]);
  if (at.length > 1) fitWith([...at, ...Object.values(found.candidates[0]?.points ?? {})]);
}

/** Whether a person has chosen the shown candidate, so that a search keeps it. */
let kept = false;

function keyOf(one?: Candidate): string {
  return JSON.stringify(one?.points);
}

/** The search that is the newest. */
let latest = Promise.resolve();
let count = 0;

/** Ask the core for the four-bars; a newer request replaces one that waits, and ends the search before. */
function solve(): Promise<void> {
  count += 1;
  latest = solveNow(count);
  return latest;
}

async function solveNow(number: number): Promise<void> {
  const isOpened = opened !== openings.value;
  opened = openings.value;
  if (!section.value) {
    solved.value = null;
    fault.value = null;
    searching.value = false;
    return;
  }
  try {
    const more = () => send("synthesis", { starts: PIECE }, "synthesis");
    let { ok } = await more();
    const first = solved.value === null || isOpened;
    searching.value = true;
    kept &&= !first;
    while (true) {
      const same = keyOf(solved.value?.candidates[chosen.value]);
      const own = kept ? ok.candidates.findIndex((one) => keyOf(one) === same) : -1;
      const ended = !(ok.tried! < ok.most!);
      const best = ok.tried === undefined ? (first ? taken.value : chosen.value) : ended ? taken.value : 0;
      solved.value = ok;
      fault.value = null;
      chosen.value = Math.max(0, Math.min(own < 0 ? (best ?? 0) : own, ok.candidates.length - 1));
      if (ended || number !== count || !searching.value) break;
      ({ ok } = await more());
    }
    if (isOpened) showAll(ok);
  } catch (error) {
    if (error instanceof Superseded) return;
    solved.value = null;
    if (error instanceof CoreError) {
      const { message, hint } = error.problem;
      fault.value = hint ? `${message}; ${hint}` : message;
    } else report(error);
  }
  if (number === count) searching.value = false;
}

/** Show a candidate. */
export function choose(k: number): void {
  [chosen.value, kept] = [k, true];
}

/** End the search with what is found; the number of starts that gives the same, if more were to come. */
export async function stop(): Promise<number | undefined> {
  searching.value = false;
  await latest;
  const { tried, most } = solved.value ?? {};
  return tried! < most! ? tried : undefined;
}

/** A pose or a point as it is written: lengths in m, and an angle with its unit. */
export function written([x, y, angle]: Triple): Value[] {
  if (draws.value) return [x, y];
  return [x, y, units.value.degrees ? `${rounded(angle * DEGREES, 0.01)} deg` : rounded(angle, 1e-6)];
}

/** The poses as they are written, to keep those that do not change. */
function rows(): Value[] {
  const found = section.value?.[list.value];
  return Array.isArray(found) ? found : [];
}

/** A pose as it is written in the text. */
export function rowOf(k: number): Value[] {
  const found = rows()[k];
  return Array.isArray(found) ? [...found] : [];
}

/** The changes that give the task these poses or points. A task of the other kind is replaced, with what only it has. */
export function withRows(next: Value[]): Change[] {
  const task = draws.value ? "path" : "motion";
  const own = section.value ?? {};
  const other = draws.value ? ["poses", "samples"] : ["points", "angles", "offsets"];
  // a search that was stopped has its number of starts
  const old = [...(task === own.task ? [] : other), "starts"].filter((key) => key in own);
  const changes: Change[] = old.map((key) => ({ path: ["synthesis", key], remove: true }));
  if (task !== own.task) changes.push({ path: ["synthesis", "task"], value: task });
  kept = false;
  return [...changes, { path: ["synthesis", list.value], value: next }];
}

/** The changes that move a pose. */
export function posed(k: number, to: Value[]): Change[] {
  return withRows(rows().map((row, j) => (j === k ? to : row)));
}

/** Add a pose; false if there are as many as a four-bar can take. */
export async function addPose(pose: Triple): Promise<boolean> {
  if (kind.value === "function") {
    announce("problem", texts.design.otherTask(String(kind.value)));
    return false;
  }
  if (rows().length >= MOST[list.value]) {
    announce("info", draws.value ? texts.design.mostPoints : texts.design.most(MOST.poses));
    return false;
  }
  const done = await change(withRows([...rows(), written(pose)]));
  if (done) active.value = rows().length - 1;
  return done;
}

export async function removePose(k: number): Promise<void> {
  active.value = null;
  const left = rows().filter((_, j) => j !== k);
  await (left.length ? change(withRows(left)) : removeTask());
}

/** Delete the section; a linkage that was taken stays. */
export function removeTask(): Promise<boolean> {
  active.value = null;
  return change([
    { path: ["synthesis", list.value], remove: true },
    { path: ["synthesis"], remove: true },
  ]);
}

/** Change one option of the task; undefined removes it. */
export function setOption(key: string, value: Value | undefined): void {
  const path = ["synthesis", key];
  void change([value === undefined ? { path, remove: true } : { path, value }]);
}
