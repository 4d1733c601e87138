// Live mode: the mechanism moves under its forces and drivers, in real time.
import { signal } from "@preact/signals";
import { snapStep } from "../draw/measure";
import { type Point, placed } from "../plane/points";
import { plainly } from "../store/blame";
import { note } from "../store/note";
import { goHome, report, send } from "../store/session";
import { preview, view } from "../store/sheet";
import { announce, home, loads, mechanism, mode, pose, poses, selection, live as state } from "../store/state";
import { texts } from "../texts";
import { Frames } from "./frames";
import { type Grip, gripAt, gripOfKeys } from "./grip";
import type { Handler } from "./handler";
import { pinOf, stopsOf, stopText, swing } from "./stops";

const frames = new Frames();
export const playing = frames.playing;
export const speed = signal(1);
/** Parameters whose values are not those of the text. */
export const changed = signal<Record<string, number>>({});
/** The longest step of a frame, s. Time beyond it is left out, because the computer is too slow. */
const LONGEST_FRAME = 0.1;
const MOST_MS = 12;
const SINGLE_STEP = 1 / 60;
/** The time of the pull, s: its stiffness is the mass of the mechanism divided by the square of this time. */
const PULL_TIME = 0.15;

/** Steps of the grid by which a key moves the end of the pull. */
const PULL = 2;

let grip: Grip | null = null;
/** The end of the pull of the keys, in the plane. */
let goal: Point | null = null;
let begun = false;

export const live: Handler = {
  down(spot) {
    grip = gripAt(spot);
    goal = null;
    if (grip) {
      selection.value = { group: "bodies", name: grip.body.name };
      void pull(spot.at);
    }
    return grip !== null;
  },
  drag: (spot) => void pull(spot.at),
  up: letGo,
  cancel: letGo,
  click: letGo,
  cursor: () => "grab",
};

export function letGo(): void {
  if (grip) void send("pull", { body: null }, "pull").catch(report);
  [grip, goal] = [null, null];
  preview.value = null;
}

/** Pull at the selected body, or the first one, until `letGo`. Each call moves the end of the pull by a step. */
export async function pullBy(dx: number, dy: number): Promise<void> {
  if (!goal) {
    const held = gripOfKeys();
    if (!held) return;
    [grip, goal] = [held.grip, held.at];
    selection.value = { group: "bodies", name: held.grip.body.name };
    announce("info", texts.live.pulled(held.grip.body.name));
  }
  const step = PULL * snapStep(view);
  goal = [goal[0] + dx * step, goal[1] + dy * step];
  await pull(goal);
}

/** Pull at the body with a spring whose strength fits the masses. */
async function pull(to: Point): Promise<void> {
  if (!grip) return;
  const mass = mechanism.value!.bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0) || 1;
  const stiffness = mass / PULL_TIME ** 2;
  const damping = 2 * 0.5 * Math.sqrt(stiffness * mass);
  const { body, point } = grip;
  try {
    await begin();
    await send("pull", { body: body.name, point, to, stiffness, damping }, "pull");
    showPull(to);
  } catch (error) {
    report(error);
  }
}

function showPull(to: Point): void {
  if (!grip) return;
  const place = poses.value[mechanism.value!.bodies.findIndex(({ name }) => name === grip!.body.name)];
  if (place) preview.value = { line: [], pull: [placed(place, grip.point), to] };
}

/** Start the simulation at the shown pose. */
async function begin(): Promise<void> {
  if (begun) return;
  begun = true;
  try {
    pose.value = (await send("live", {})).ok;
  } catch (error) {
    begun = false;
    throw error;
  }
}

/** Return a dragged mechanism to its start if it has drivers, because they prescribe the pose. */
async function goToDrivers(): Promise<void> {
  const [now, before] = [pose.value?.q, home.value?.q];
  if (begun || !mechanism.value?.drivers.length || !now || !before) return;
  if (now.some((one, k) => one !== before[k])) await goHome();
}

export async function play(): Promise<void> {
  const [started, loaded] = [mode.value, loads.value];
  await goToDrivers();
  if (mode.value !== started) return;
  const each = (ms: number) => {
    if (mode.value !== started) return false;
    const by = Math.min(LONGEST_FRAME, ms / 1000) * speed.value;
    return by > 0 ? advance(by) : true;
  };
  // a step of a mechanism that another text has replaced meanwhile
  await frames.play(each, begin).catch((error) => loads.value === loaded && report(error));
}

/** Advance by simulated seconds; false if the motion has ended. */
async function advance(by: number): Promise<boolean> {
  const { ok } = await send("advance", { by, most_ms: MOST_MS });
  state.value = ok;
  pose.value = ok;
  const pulled = preview.value?.pull;
  if (pulled && view) showPull(pulled[1]);
  if (ok.ended) await explain(ok.ended);
  else if (ok.events.length) announce("info", texts.live.event(ok.events.map(({ name }) => name).join(", ")));
  return !ok.ended;
}

/** Say why a motion has ended: where the crank stops, otherwise in the words of the core. */
async function explain(ended: string): Promise<void> {
  const last = pose.value;
  const stops = await stopsOf();
  begun = false;
  pose.value = last;
  const again = () => stops && void swing(stops).then(play);
  const action = stops?.low && stops.high ? { action: { label: texts.read.swing, run: again } } : {};
  const words = stops ? stopText(stops) : plainly(ended);
  announce("problem", words, action);
  const at = stops && pinOf(words, poses.value);
  if (at) note.value = { at: view.toScreen(at), text: words, kind: "wrong" };
}

export function pause(): void {
  frames.stop();
}

export function toggle(): void {
  if (playing.value) pause();
  else void play();
}

export async function step(): Promise<void> {
  pause();
  try {
    await goToDrivers();
    await begin();
    await advance(SINGLE_STEP * speed.value);
  } catch (error) {
    report(error);
  }
}

/** End the motion. The next one starts at the pose of the mechanism at that time. */
export function stop(): void {
  pause();
  letGo();
  begun = false;
  state.value = null;
}

/** Change parameters during the motion. */
export async function setParameters(values: Record<string, number>): Promise<void> {
  try {
    const { ok } = await send("parameters", { values }, "parameters");
    changed.value = { ...changed.value, ...values };
    if (!playing.value) pose.value = ok;
  } catch (error) {
    report(error);
  }
}
