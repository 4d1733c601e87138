// Design mode: clicks place poses of the coupler or points of its path, drags move and turn them, or draw the path.
import type { Triple } from "../core/protocol";
import { snapStep } from "../draw/measure";
import type { Handler, Spot } from "../modes/handler";
import { distance, type Point, rounded } from "../plane/points";
import { Draft } from "../store/document";
import { report } from "../store/session";
import { view } from "../store/sheet";
import { snapping } from "../store/state";
import { cams } from "./cam";
import { ORIGIN, tipOf } from "./painting";
import { begin, drop, finish, follow, stroke } from "./stroke";
import { active, addPose, draws, posed, poses, single, written } from "./task";

/** Angles snap to multiples of this, rad. */
const TURN = Math.PI / 12;
/** How far from a handle a press takes it, px; with a finger. */
const REACH = 13;
const FINGER = 24;

interface Held {
  k: number;
  turns: boolean;
  draft: Draft;
}

let held: Held | null = null;
let over = false;

/** The pose under a place, and whether it is its arm. */
function under({ px, touch }: Spot): { k: number; turns: boolean } | null {
  const reach = touch ? FINGER : REACH;
  if (!single.value) return null;
  const all = poses.value.flatMap((pose, k) => [
    { k, turns: false, far: distance(px, view.toScreen([pose[0], pose[1]])) - ORIGIN / 2 },
    ...(draws.value ? [] : [{ k, turns: true, far: distance(px, tipOf(view, pose)) }]),
  ]);
  const near = all.filter(({ far }) => far < reach).sort((a, b) => a.far - b.far);
  return near[0] ?? null;
}

/** A place on the grid, if snapping is on. */
function snapped([x, y]: Point, free: boolean): Point {
  const step = snapStep(view);
  const round = (value: number) => (free ? rounded(value, step / 100) : rounded(Math.round(value / step) * step, step));
  return [round(x), round(y)];
}

function isFree(spot: Spot): boolean {
  return spot.free || !snapping.value;
}

function moved({ k, turns }: Held, spot: Spot): Triple {
  const [x, y, angle] = poses.value[k]!;
  if (!turns) return [...snapped(spot.at, isFree(spot)), angle];
  const turned = Math.atan2(spot.at[1] - y, spot.at[0] - x);
  return [x, y, isFree(spot) ? turned : Math.round(turned / TURN) * TURN];
}

export const design: Handler = {
  down(spot) {
    if (cams.value) return false;
    const found = under(spot);
    if (!found) {
      if (draws.value) begin(spot.at);
      return draws.value;
    }
    active.value = found.k;
    held = { ...found, draft: new Draft() };
    return true;
  },
  drag(spot) {
    follow(spot.at);
    if (held && poses.value[held.k]) held.draft.show(posed(held.k, written(moved(held, spot))));
  },
  up() {
    void finish().catch(report);
    void held?.draft.keep().catch(report);
    held = null;
  },
  cancel() {
    drop();
    void held?.draft.drop().catch(report);
    held = null;
  },
  click(spot) {
    if (cams.value) return;
    const found = under(spot);
    if (found) active.value = found.k;
    else place(snapped(spot.at, isFree(spot)));
  },
  double: () => true,
  hover(spot) {
    over = spot !== null && under(spot) !== null;
  },
  cursor: () => (cams.value ? "grab" : over && !stroke.value.length ? "move" : "crosshair"),
};

/** Add a pose with the angle of the last one. */
function place(at: Point): void {
  void addPose([...at, poses.value.at(-1)?.[2] ?? 0]).catch(report);
}

/** Add a pose beside the last one, for keys. */
export function addBeside(): void {
  const last = poses.value.at(-1);
  const [x, y] = last ?? [...snapped(view.center, false), 0];
  place(last ? [x + 10 * snapStep(view), y] : [x, y]);
}

/** Move the selected pose by a step of the grid. */
export function pushPose(dx: number, dy: number): void {
  const k = active.value;
  const pose = k === null ? undefined : poses.value[k];
  if (k === null || !pose) return;
  const step = snapStep(view);
  const at = snapped([pose[0] + dx * step, pose[1] + dy * step], false);
  const draft = new Draft();
  void draft.apply(posed(k, written([...at, pose[2]]))).then(() => draft.keep(), report);
}
