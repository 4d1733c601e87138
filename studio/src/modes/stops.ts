// Where a driven crank stops, because the mechanism cannot follow it, and the law with which it swings between its ends.
import type { Ran } from "../core/protocol";
import { displayed } from "../draw/display";
import { besideUnit, significant } from "../draw/numbers";
import { speedsOf } from "../edit/driving";
import { distance, type Point, placed } from "../plane/points";
import { change } from "../store/document";
import { send } from "../store/session";
import { home, mechanism, scene, tree, units } from "../store/state";
import { texts } from "../texts";
import { driven, OUTPUTS, quantityOf } from "./starting";

/** One end of the motion of a coordinate. */
interface End {
  value: number;
  reason: string;
}

export interface Stops {
  driver: string;
  coordinate: string;
  unit: string;
  begin: number;
  /** The ends below and above the start; null where the coordinate has none. */
  low: End | null;
  high: End | null;
}

/** A swing ends at this share of the way to a dead point. */
const SHARE = 0.98;

/** The ends of the motion of the first driver that has one. The runs for this replace the last run of the core. */
export async function stopsOf(): Promise<Stops | null> {
  for (const { name, coordinate } of driven()) {
    const unit = /\.(angle|theta)$/.test(coordinate) ? "rad" : "m";
    const [x0, y0, x1, y1] = scene.value?.bounds ?? [0, 0, 1, 1];
    const span = unit === "rad" ? 2 * Math.PI : 3 * Math.max(x1 - x0, y1 - y0);
    await send("pose", { q: home.value!.q });
    const begin = await quantityOf(coordinate);
    const low = await endOf(coordinate, begin, -span);
    await send("pose", { q: home.value!.q });
    const high = await endOf(coordinate, begin, span);
    await send("pose", { q: home.value!.q });
    if (low || high) return { driver: name, coordinate, unit, begin, low, high };
  }
  return null;
}

async function endOf(over: string, begin: number, span: number): Promise<End | null> {
  const range: [string, string] = [String(begin), String(begin + span)];
  const found = await send("run", { over, range }).then(
    ({ ok }) => ok as Ran,
    () => null,
  );
  const [, of, value, degrees, reason] =
    /(\S+) cannot pass (\S+?)(°?)(?: \S+)?: (.*)/s.exec(found?.error?.message ?? "") ?? [];
  // with several drivers, the end may be that of another one; an angle has the name of its body
  return reason === undefined || (of !== over && `${of}.angle` !== over)
    ? null
    : { value: Number(value) * (degrees ? Math.PI / 180 : 1), reason };
}

/** The end that the driver reaches first, in words. */
export function stopText({ coordinate, unit, begin, low, high }: Stops, at?: number): string {
  const ends = [low, high].filter((end): end is End => end !== null);
  const near = (end: End) => Math.abs(end.value - (at ?? begin));
  const { value, reason } = ends.sort((a, b) => near(a) - near(b))[0]!;
  const { factor, unit: written } = displayed(unit, units.value);
  const end = besideUnit(significant(value * factor), written);
  return texts.read.stops(coordinate.replace(/\.[^.]*$/, ""), end, reason);
}

/** The point of the pin between two bodies that a reason names, at some poses. */
export function pinOf(text: string, poses: readonly (readonly [number, number, number])[]): Point | null {
  const named = (mechanism.value?.bodies ?? []).flatMap((body, k) => {
    const pose = poses[k];
    return pose && !body.ground && new RegExp(`(?<![\\w.])${body.name}(?!\\w)`, "u").test(text.slice(text.indexOf(":")))
      ? [Object.values(body.points).map((at) => placed(pose, at))]
      : [];
  });
  const [first, second] = named;
  const size = Math.max(...(scene.value?.bounds ?? [1]).map(Math.abs), 1e-9);
  return first?.find((a) => second?.some((b) => distance(a, b) < 1e-6 * size)) ?? first?.[0] ?? null;
}

/** Let a driver swing between its ends; returns the time of one swing, or null if it is not between two ends. */
export async function swing({ driver, begin, low, high }: Stops): Promise<number | null> {
  if (!low || !high || !(low.value < begin && begin < high.value)) return null;
  const middle = (low.value + high.value) / 2;
  const reach = (SHARE * (high.value - low.value)) / 2;
  const own = speedsOf(tree.value, mechanism.value?.parameters ?? []).find((one) => one.driver === driver);
  const speed = own?.value || 1;
  const phase = Math.asin(Math.max(-1, Math.min(1, (begin - middle) / reach)));
  const [m, r, p] = [middle, reach, phase].map((one) => Number(one.toPrecision(8)));
  const law = `${m} + ${r}*sin(${own?.parameter ?? 1}*t/${r} + ${p})`.replaceAll("+ -", "- ");
  const turn = Number(((2 * Math.PI * reach) / Math.abs(speed)).toPrecision(6));
  const analyses = (mechanism.value?.analyses ?? []).map(({ name }) => name).slice(0, 1);
  const done = await change([
    { path: ["drivers", driver, "value"], value: law },
    ...analyses.flatMap((name) => [
      { path: ["analyses", name, "t_end"], value: turn },
      { path: ["analyses", name, "output_step"], value: Number((turn / OUTPUTS).toPrecision(6)) },
    ]),
  ]);
  return done ? turn : null;
}
