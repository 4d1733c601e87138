// Read mode: a run of an analysis, its poses over time, its quantities.
import { batch, computed, effect, signal } from "@preact/signals";
import type { Found, Pose, Quantity, Ran, Requests } from "../core/protocol";
import { nearest, placeIn } from "../plane/instants";
import { plainly } from "../store/blame";
import { diagram } from "../store/diagram";
import { note } from "../store/note";
import { redraw, report, Superseded, send, showPresent } from "../store/session";
import { fitMotion, fitWith, preview, view } from "../store/sheet";
import { announce, mechanism, mode, openings, pose, poses, selection } from "../store/state";
import { texts } from "../texts";
import { Frames } from "./frames";
import { gripAt } from "./grip";
import type { Handler } from "./handler";
import { OVER, offer, over, rangeOfCore, TIME } from "./over";
import { written } from "./shown";
import { duration, endBefore, hasMoved, withAnalysis } from "./starting";
import { pinOf, type Stops, stopsOf, stopText, swing } from "./stops";

/** A run with its frames: t and the poses of all moving bodies, row by row. A run to lower values is reversed. */
export interface Course {
  ran: Ran;
  backwards: boolean;
  t: Float64Array;
  rows: Float64Array;
  width: number;
}

export const course = signal<Course | null>(null);
/** The last result that is not a motion, in place of a run. */
export const found = signal<Found | null>(null);
/** The number of the drawn position of this result. */
export const place = signal(0);
/** Remarks on the result, which the user must see. */
export const remarks = computed(() => (course.value?.ran ?? found.value)?.remarks ?? []);
export const quantities = signal<Quantity[]>([]);
/** The joints and drivers whose reactions are not unique. The shown reactions are the smallest ones. */
export const notUnique = computed(() => course.value?.ran.not_unique ?? []);
/** Forces and joints whose load contacts and friction at rest share in more than one way. */
export const sharedLoads = computed(() => course.value?.ran.shared ?? []);
export const time = signal(0);
const frames = new Frames();
export const playing = frames.playing;
export const rate = signal(1);
export const running = signal(false);
/** The chosen analysis of the case; empty for dynamics from the shown pose. */
export const chosen = signal<string | null>(null);
/** The analyses of the case. */
export const analyses = computed(() => mechanism.value?.analyses ?? []);

/** The analysis of the next run: the chosen one if the case contains it, otherwise the first. */
export const analysis = computed(() => {
  if (chosen.value === "" || chosen.value === OVER || analyses.value.some(({ name }) => name === chosen.value))
    return chosen.value!;
  return analyses.value[0]?.name ?? "";
});

effect(() => {
  openings.value;
  chosen.value = null;
});

/** The quantity in place of the time, with its SI unit; otherwise the time. */
export const variable = computed<Quantity>(() => course.value?.ran.over ?? TIME);

/** What forces over this quantity contain; empty over time. */
export const condition = computed(() => course.value?.ran.over?.condition ?? "");

/** A run over a quantity is played in this time, s. */
const PLAYED = 5;

export const span = computed<[number, number]>(() => {
  const t = course.value?.t;
  return t?.length ? [t[0]!, t[t.length - 1]!] : [0, 0];
});

export const read: Handler = {
  click(spot) {
    const grip = gripAt(spot);
    selection.value = grip ? { group: "bodies", name: grip.body.name } : null;
  },
  cursor: () => "grab",
};

/** The name of a quantity or element, with a star if its forces are not unique. */
export function starred(name: string, of: string, unit = "N"): string {
  const marked = ["N", "N·m"].includes(unit) && [...notUnique.value, ...sharedLoads.value].includes(of);
  return marked ? `${name} *` : name;
}

/** Run the chosen analysis, the one with a name, or dynamics until a time. */
export async function run(of?: number | string): Promise<Ran | Found | null> {
  running.value = true;
  if (typeof of === "string") chosen.value = of;
  try {
    const fields =
      typeof of === "string" ? { analysis: of } : of === undefined ? await requested() : await untilTime(of);
    let { ok } = await send("run", fields);
    const stops = "count" in ok && ok.error && !("over" in fields) ? await stopsOf() : null;
    // a case that was drawn changes its motion by itself; the analysis of another case may ask for this one
    const name = "analysis" in fields && fields.analysis === drawn ? drawn : null;
    const turn = stops && name !== null ? await swing(stops) : null;
    if (stops) ({ ok } = await send("run", turn && name ? { analysis: name } : fields));
    const reached = "count" in ok && ok.error && (turn || !stops) && name ? ok.t_end : 0;
    const ends = name !== null && (await endBefore(name, reached));
    if (ends) ({ ok } = await send("run", { analysis: name }));
    await ("count" in ok
      ? showMotion(ok, stops && !ends ? { stops, swings: turn !== null } : undefined)
      : showFound(ok));
    if (ends && !ok.error) announce("info", texts.read.shortened(written(reached, "s")));
    return ok;
  } catch (error) {
    report(error);
    return null;
  } finally {
    running.value = false;
  }
}

/** Show a result that is not a motion, with its first position. */
async function showFound(ok: Found): Promise<void> {
  pause();
  batch(() => {
    course.value = null;
    found.value = ok;
  });
  if (ok.outlines.length) fitWith(ok.outlines.flat());
  announce("done", texts.read.found);
  await showPlace(0);
}

/** Draw a position of a result that is not a motion. */
export async function showPlace(number: number): Promise<void> {
  place.value = number;
  const position = found.value?.positions[number];
  if (!position) await showPresent();
  else if (mode.value === "read") pose.value = position.pose;
}

/** Fetch the frames of a motion, and show its start. */
async function showMotion(ok: Ran, end?: { stops: Stops; swings: boolean }): Promise<void> {
  const { numbers } = await send("frames", {});
  const width = 1 + 3 * ((mechanism.value?.bodies.length ?? 1) - 1);
  const frames = inOrder(numbers, width);
  const ground = mechanism.value?.bodies[0]?.name ?? "";
  const all = (await send("quantities", { of_run: true })).ok.filter(({ name }) => !name.startsWith(`${ground}.`));
  batch(() => {
    found.value = null;
    course.value = { ran: ok, width, ...frames };
    time.value = frames.t[0] ?? 0;
    quantities.value = all;
  });
  void fitMotion(redraw).catch(report); // slots and guides are as long as the travel
  if (end) showEnd(end.stops, end.swings);
  else if (ok.error) announce("problem", plainly(ok.error.message), ok.error.hint ? { hint: ok.error.hint } : {});
  else announce("done", texts.read.done(ok.count, variable.value.name, written(ok.t_end, variable.value.unit)));
  if (!end || end.swings) show(time.value);
}

/** Say where the crank stops, and mark the place; it may swing between its ends instead. */
function showEnd(stops: Stops, swings: boolean): void {
  if (swings) {
    announce("info", texts.read.swings(stopText(stops)));
    return;
  }
  show(span.value[1]);
  const words = stopText(stops);
  const again = () => void swing(stops).then(() => run());
  const action = stops.low && stops.high ? { action: { label: texts.read.swing, run: again } } : {};
  announce("problem", words, action);
  const at = pinOf(words, poses.value);
  if (!at) return;
  note.value = { at: view.toScreen(at), text: words, kind: "wrong" };
  preview.value = { line: [], mark: { at, kind: "point" } };
}

/** The analysis that the page has added to a drawn case. */
let drawn: string | null = null;

/** The request of the run that is chosen in the panel. */
async function requested(): Promise<Requests["run"]["send"]> {
  const begins = chosen.value === null && !(hasMoved() && !mechanism.value?.drivers.length);
  if (begins && !analyses.value.length && (await withAnalysis())) drawn = analysis.value;
  if (analysis.value !== OVER) return analysis.value ? { analysis: analysis.value } : untilTime();
  offer((await send("quantities", {})).ok);
  const range = rangeOfCore();
  if (!over.value || !range) throw new Error(texts.read.noRange);
  return { over: over.value.name, range };
}

/** Times and frames in the order of growing times. */
export function inOrder(numbers: Float64Array, width: number): Pick<Course, "t" | "rows" | "backwards"> {
  const n = Math.floor(numbers.length / width);
  const backwards = n > 1 && numbers[0]! > numbers[(n - 1) * width]!;
  const rows = new Float64Array(numbers.length);
  for (let k = 0; k < n; k += 1) {
    const from = (backwards ? n - 1 - k : k) * width;
    rows.set(numbers.subarray(from, from + width), k * width);
  }
  return { t: Float64Array.from({ length: n }, (_, k) => rows[k * width]!), rows, backwards };
}

/** The request of a run from the pose of the core until `t_end`, or for one turn. */
async function untilTime(t_end?: number): Promise<{ t_end: number; output_step: number }> {
  const { t } = (await send("pose", {})).ok;
  const usual = await duration();
  const end = t_end ?? t + usual.t_end;
  return { t_end: end, output_step: ((end - t) / usual.t_end) * usual.output_step };
}

/** The poses at one time, by linear interpolation between frames. */
export function posesAt({ t, rows, width }: Pick<Course, "t" | "rows" | "width">, at: number): Pose["poses"] {
  const { low, high, share } = placeIn(t, at);
  return Array.from({ length: (width - 1) / 3 }, (_, body) => {
    const value = (k: number) => {
      const [a, b] = [rows[low * width + 1 + 3 * body + k]!, rows[high * width + 1 + 3 * body + k]!];
      return a + share * (b - a);
    };
    return [value(0), value(1), value(2)];
  });
}

/** Show the mechanism at a time of the run. */
export function show(at: number): void {
  const run = course.value;
  if (!run?.t.length) return;
  time.value = Math.min(span.value[1], Math.max(span.value[0], at));
  const base = pose.value;
  // diagrams are those of an output
  const t = diagram.value === "none" ? time.value : run.t[nearest(run.t, time.value)]!;
  if (base && mode.value === "read") pose.value = { ...base, t, poses: posesAt(run, t) };
}

export async function play(): Promise<void> {
  if (!course.value) return;
  note.value = preview.value = null;
  if (time.value >= span.value[1]) show(span.value[0]);
  await frames.play((ms) => {
    if (mode.value !== "read") return false;
    const pace = variable.value === TIME ? 1 : (span.value[1] - span.value[0]) / PLAYED;
    const next = time.value + (Math.min(500, ms) / 1000) * rate.value * pace;
    show(next >= span.value[1] ? span.value[0] : next);
    return true;
  });
}

export function pause(): void {
  frames.stop();
}

export function toggle(): void {
  if (playing.value) pause();
  else void play();
}

/** Values of quantities at all outputs, one row for each name. Raises `Superseded` if another run replaces this one. */
export async function valuesOf(names: string[]): Promise<{ units: string[]; rows: Float64Array[] }> {
  const run = course.value;
  const { ok, numbers } = await send("values", { names }).catch((error: unknown) => {
    throw course.value === run ? error : new Superseded();
  });
  const n = numbers.length / Math.max(1, names.length);
  const row = (k: number) => numbers.slice(k * n, (k + 1) * n);
  return { units: ok.units, rows: names.map((_, k) => (run?.backwards ? row(k).reverse() : row(k))) };
}
