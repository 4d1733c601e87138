// The task of the section [synthesis]: poses of a coupler, and the four-bars through them that the core finds.
import { computed, effect, signal } from "@preact/signals";
import { isTable } from "../catalogue/tree";
import type { Change, Solved, Tree, Triple, Value } from "../core/protocol";
import { CoreError, Superseded } from "../core/transport";
import { type Point, rounded } from "../plane/points";
import { change } from "../store/document";
import { report, send } from "../store/session";
import { fitWith } from "../store/sheet";
import { announce, loads, mode, openings, tree, units } from "../store/state";
import { texts } from "../texts";

/** The most poses that a four-bar takes exactly. */
export const MOST = 5;
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
export const poses = computed<Triple[]>(() => solved.value?.poses ?? []);
export const candidate = computed(() => solved.value?.candidates[chosen.value] ?? null);
/** The candidate that the bodies of the case are, from 0. */
export const taken = computed<number | null>(() => {
  const found = section.value?.choice;
  return typeof found === "number" ? found - 1 : null;
});

effect(() => {
  loads.value;
  if (mode.value === "design") void solve();
});

/** The opening of the case to which the answer belongs. */
let opened = -1;

/** Show all poses of a case that was opened. */
function showAll(found: Solved): void {
  active.value = null;
  const at = found.poses.map(([x, y]): Point => [x, y]);
  if (at.length > 1) fitWith([...at, ...Object.values(found.candidates[0]?.points ?? {})]);
}

/** Ask the core for the four-bars; a newer request replaces one that waits. */
async function solve(): Promise<void> {
  if (!section.value) {
    solved.value = null;
    fault.value = null;
    return;
  }
  try {
    const { ok } = await send("synthesis", {}, "synthesis");
    const first = solved.value === null || opened !== openings.value;
    opened = openings.value;
    solved.value = ok;
    if (first) showAll(ok);
    fault.value = null;
    const wanted = first ? (taken.value ?? 0) : chosen.value;
    chosen.value = Math.max(0, Math.min(wanted, ok.candidates.length - 1));
  } catch (error) {
    if (error instanceof Superseded) return;
    solved.value = null;
    if (error instanceof CoreError) {
      const { message, hint } = error.problem;
      fault.value = hint ? `${message}; ${hint}` : message;
    } else report(error);
  }
}

/** A pose as it is written: lengths in m, and an angle with its unit. */
export function written([x, y, angle]: Triple): Value[] {
  return [x, y, units.value.degrees ? `${rounded(angle * DEGREES, 0.01)} deg` : rounded(angle, 1e-6)];
}

/** The poses as they are written, to keep those that do not change. */
function rows(): Value[] {
  const found = section.value?.poses;
  return Array.isArray(found) ? found : [];
}

/** A pose as it is written in the text. */
export function rowOf(k: number): Value[] {
  const found = rows()[k];
  return Array.isArray(found) ? [...found] : [];
}

/** The changes that give the task these poses. */
function withPoses(next: Value[]): Change[] {
  const own: Change[] = section.value ? [] : [{ path: ["synthesis", "task"], value: "motion" }];
  return [...own, { path: ["synthesis", "poses"], value: next }];
}

/** The changes that move a pose. */
export function posed(k: number, to: Value[]): Change[] {
  return withPoses(rows().map((row, j) => (j === k ? to : row)));
}

/** Add a pose; false if there are as many as a four-bar can take. */
export async function addPose(pose: Triple): Promise<boolean> {
  if (section.value && section.value.task !== "motion") {
    announce("problem", texts.design.otherTask(String(section.value.task)));
    return false;
  }
  if (rows().length >= MOST) {
    announce("info", texts.design.most(MOST));
    return false;
  }
  const done = await change(withPoses([...rows(), written(pose)]));
  if (done) active.value = rows().length - 1;
  return done;
}

export async function removePose(k: number): Promise<void> {
  active.value = null;
  const left = rows().filter((_, j) => j !== k);
  await change(
    left.length
      ? withPoses(left)
      : [
          { path: ["synthesis", "poses"], remove: true },
          { path: ["synthesis"], remove: true },
        ],
  );
}

/** Change one option of the task; undefined removes it. */
export function setOption(key: string, value: Value | undefined): void {
  const path = ["synthesis", key];
  void change([value === undefined ? { path, remove: true } : { path, value }]);
}
