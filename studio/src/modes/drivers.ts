// Playing the drivers: the motion from the start, frame by frame.
import { signal } from "@preact/signals";
import { report, send } from "../store/session";
import { announce, mechanism, mode, pose } from "../store/state";
import { type Course, posesAt } from "./read";

export const playing = signal(false);
/** One round of the drivers that is played, s, and its frames. */
const SPAN = 8;
const FRAMES = 480;

export async function toggle(): Promise<void> {
  if (playing.value) {
    playing.value = false;
    return;
  }
  playing.value = true;
  try {
    const course = await kinematics();
    if (course) await show(course);
  } catch (error) {
    report(error);
  }
  playing.value = false;
}

/** The motion that the drivers determine, as a run from the start. */
async function kinematics(): Promise<Course | null> {
  const { ok } = await send("run", { t_end: SPAN, output_step: SPAN / FRAMES });
  const { numbers } = await send("frames", {});
  if (ok.error) announce("problem", ok.error.message);
  const width = 1 + 3 * ((mechanism.value?.bodies.length ?? 1) - 1);
  const t = Float64Array.from({ length: Math.floor(numbers.length / width) }, (_, k) => numbers[k * width]!);
  return t.length > 1 ? { ran: ok, t, rows: numbers, width } : null;
}

async function show(course: Course): Promise<void> {
  const [begin, end] = [course.t[0]!, course.t.at(-1)!];
  let [at, last] = [begin, performance.now()];
  while (playing.value && mode.value === "move") {
    const now = await new Promise<number>((done) => requestAnimationFrame(done));
    at += Math.min(0.5, Math.max(0, now - last) / 1000);
    last = now;
    if (at > end) at = begin;
    const base = pose.value;
    if (base) pose.value = { ...base, t: at, poses: posesAt(course, at) };
  }
}
