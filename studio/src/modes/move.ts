// Move mode: all lengths stay, and the mechanism follows the pointer on its branch.
import { signal } from "@preact/signals";
import type { Pose } from "../core/protocol";
import { snapStep } from "../draw/measure";
import { distance, type Point, placed } from "../plane/points";
import { report, send } from "../store/session";
import { preview, view } from "../store/sheet";
import { announce, mechanism, message, pose, poses, selection } from "../store/state";
import { texts } from "../texts";
import { type Grip, gripAt, gripOfKeys } from "./grip";
import type { Handler } from "./handler";
import * as living from "./live";

/** Coordinates that a drag does not change. */
export const locked = signal<string[]>([]);
/** All configurations with the free coordinates of the present pose. */
export const configurations = signal<{ complete: boolean; poses: Pose[] } | null>(null);

/** The number of snap steps of one push by a key. */
const PUSH = 2;

let grip: Grip | null = null;
let target: Point | null = null;
let working = false;

export const move: Handler = {
  down(spot) {
    grip = gripAt(spot);
    living.stop();
    if (grip) selection.value = { group: "bodies", name: grip.body.name };
    return grip !== null;
  },
  drag(spot) {
    if (!grip) return;
    target = spot.at;
    if (!working) void follow(grip);
  },
  up: letGo,
  cancel: letGo,
  click(spot) {
    const found = gripAt(spot);
    selection.value = found ? { group: "bodies", name: found.body.name } : null;
  },
  cursor: () => "grab",
};

function letGo(): void {
  grip = null;
  preview.value = null;
  configurations.value = null;
}

/** Send the newest position of the pointer: one request at a time, at most one for each frame. */
async function follow({ body, point }: Grip): Promise<void> {
  working = true;
  try {
    while (target) {
      const to = target;
      target = null;
      const { ok } = await send("drag", { body: body.name, point, to, locked: locked.value });
      pose.value = ok.pose;
      showPull(body.name, point, to);
      if (ok.stopped) announce("info", ok.stopped);
      else if (message.value?.kind === "info") message.value = null;
      await new Promise((done) => requestAnimationFrame(done));
    }
  } catch (error) {
    report(error);
  }
  working = false;
}

/** Move the selected body, or the first one, by a step. */
export async function push(dx: number, dy: number): Promise<void> {
  const held = gripOfKeys();
  if (!held || working) return;
  const step = PUSH * snapStep(view);
  target = [held.at[0] + dx * step, held.at[1] + dy * step];
  living.stop();
  await follow(held.grip);
}

/** Draw a line from the body to the pointer if the body cannot follow. */
function showPull(name: string, point: Point, to: Point): void {
  const at = poses.value[mechanism.value!.bodies.findIndex((body) => body.name === name)];
  const from = at && placed(at, point);
  preview.value = from && grip && distance(from, to) * view.scale > 6 ? { line: [], pull: [from, to] } : null;
}

/** Find all assembly modes. */
export async function findConfigurations(): Promise<void> {
  try {
    configurations.value = (await send("configurations", { limit: 24 })).ok;
    if (configurations.value.poses.length === 1) announce("info", texts.move.only);
  } catch (error) {
    report(error);
  }
}

/** Continue from another pose. */
export async function choose(other: Pose): Promise<void> {
  living.stop();
  try {
    pose.value = (await send("pose", { q: other.q })).ok;
  } catch (error) {
    report(error);
  }
}
