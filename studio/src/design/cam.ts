// The cam that design mode shows: what is typed, what the core computes of it, and its case and drawing.
import { computed, effect, signal, untracked } from "@preact/signals";
import type { CamFound, CamGiven } from "../core/protocol";
import { CoreError, Superseded } from "../core/transport";
import { download } from "../give/download";
import type { Point } from "../plane/points";
import { open } from "../store/document";
import { report, send } from "../store/session";
import { fit, view } from "../store/sheet";
import { mode, openings, text } from "../store/state";
import { filled, missing, type Segment } from "./segments";

const RADIANS = Math.PI / 180;

/** Whether design mode shows the cam. */
export const cams = signal(false);
/** The programmes of a translating and of an oscillating follower. */
const programmes = {
  translating: signal<Segment[]>(begun(0.01)),
  oscillating: signal<Segment[]>(begun(15)),
};

function begun(height: number): Segment[] {
  const law = "cycloidal";
  return [
    { way: "rise", angle: 100, height, law },
    { way: "dwell", angle: 40, height: null, law },
    { way: "return", angle: 100, height: null, law },
    { way: "dwell", angle: 120, height: null, law },
  ];
}

export const FOLLOWERS = ["roller", "knife", "flat"] as const;
export const MOTIONS = ["translating", "oscillating"] as const;
export const CLOSURES = ["force", "groove", "conjugate"] as const;
export const DIRECTIONS = ["ccw", "cw"] as const;

/** Kinds and sizes, in SI units. */
export const sizes = signal({
  follower: "roller" as (typeof FOLLOWERS)[number],
  motion: "translating" as (typeof MOTIONS)[number],
  closure: "force" as (typeof CLOSURES)[number],
  direction: "ccw" as (typeof DIRECTIONS)[number],
  base_radius: 0.03,
  roller_radius: 0.008,
  offset: 0,
  arm: 0.07,
  x: 0.08,
  y: 0.01,
  face: 0,
  speed: 2 * Math.PI,
  mass: 1,
  stiffness: 0,
  force: 0,
});
export type Sizes = typeof sizes.value;

export const segments = computed(() => programmes[sizes.value.motion].value);
export const lack = computed(() => missing(segments.value));
/** The answer of the core, and the reason why there is none. */
export const found = signal<CamFound | null>(null);
export const fault = signal("");
/** The case that *Use* has written. */
const used = signal<string | null>(null);
/** Whether the mechanism of the text is the shown cam. */
export const isUsed = computed(() => used.value !== null && used.value === text.value);

export function setSegments(next: Segment[]): void {
  programmes[sizes.value.motion].value = next;
}

export function setSizes(next: Partial<Sizes>): void {
  const made = { ...sizes.value, ...next };
  if (made.follower !== "roller" && made.closure === "groove") made.closure = "force";
  sizes.value = made;
}

export function fill(): void {
  setSegments(filled(segments.value));
}

/** What the core is asked. */
export function asked(of: Sizes, all: readonly Segment[]): CamGiven {
  const { motion, roller_radius, offset, arm, x, y, face, stiffness, force, ...same } = of;
  const swings = motion === "oscillating";
  const height = (value: number) => (swings ? value * RADIANS : value);
  return {
    ...same,
    roller_radius: of.follower === "roller" ? roller_radius : 0,
    offset: swings ? 0 : offset,
    arm: swings ? arm : null,
    pivot: swings ? [x, y] : null,
    face: swings && of.follower === "flat" ? face : 0,
    spring: [stiffness, force],
    gravity: 9.81,
    programme: all.map(({ way, angle, height: h, law }) => ({
      way,
      angle: angle * RADIANS,
      lift: way === "dwell" || h === null ? null : height(h),
      law,
    })),
  };
}

const given = computed(() => asked(sizes.value, segments.value));
/** Whether the sheet shows the cam. */
export const shows = computed(() => cams.value && mode.value === "design");
/** What the sheet shows without the cam. */
let before: { bounds: typeof view.bounds; opening: number } | null = null;

effect(() => {
  const on = shows.value;
  untracked(() => {
    if (on) {
      before ??= { bounds: view.bounds, opening: openings.value };
      frame(true);
    } else if (before) {
      if (before.opening === openings.value) view.bounds = before.bounds;
      before = null;
      fit();
    }
  });
});

effect(() => {
  const of = given.value;
  if (shows.value) void solve(of);
});

async function solve(of: CamGiven): Promise<void> {
  try {
    const { ok } = await send("cam", of, "cam");
    const first = found.value === null;
    [found.value, fault.value] = [ok, ""];
    frame(first);
  } catch (error) {
    if (error instanceof Superseded) return;
    if (!(error instanceof CoreError)) return report(error);
    const { message, hint } = error.problem;
    fault.value = hint ? `${message}; ${hint}` : message;
  }
}

/** Let *Fit* show the whole cam with its follower, and show it now. */
function frame(now: boolean): void {
  const { curves, start } = found.value ?? {};
  if (!curves || !start || !shows.value) return;
  const far = Math.max(...Object.values(curves).flat().map(Math.abs));
  view.bounds = [-1.3 * far, -1.3 * far, 1.3 * far, Math.max(1.3 * far, start.pitch[1] + 2 * sizes.value.base_radius)];
  if (now) fit();
}

/** Pairs of numbers as places. */
export function places(flat: readonly number[]): Point[] {
  return Array.from({ length: flat.length / 2 }, (_, k): Point => [flat[2 * k]!, flat[2 * k + 1]!]);
}

async function answered<T>(request: Promise<{ ok: T }>): Promise<T | null> {
  try {
    return (await request).ok;
  } catch (error) {
    report(error);
    return null;
  }
}

/** Open the cam with its follower as a case; undo brings the present one back. */
export async function use(): Promise<void> {
  const of = await answered(send("cam_case", given.value));
  if (!of || (await open(of.text, { name: "cam.toml" })) !== null) return;
  used.value = of.text;
}

/** Offer the profiles as a drawing. */
export async function saveDrawing(): Promise<void> {
  const of = await answered(send("cam_drawing", given.value));
  if (of) download("cam.dxf", of.text, "image/vnd.dxf");
}
