// How a motion begins and how long it takes: the analysis of a drawn case, and the pose to which a driven crank was moved.
import { entries, freeName } from "../catalogue/tree";
import type { Change, Tree, Value } from "../core/protocol";
import { rateOf } from "../edit/start";
import { change } from "../store/document";
import { send } from "../store/session";
import { announce, catalogue, home, mechanism, pose, tree } from "../store/state";
import { texts } from "../texts";

/** The end of a motion without a crank that turns, s, and the longest turn. */
const T_END = 5;
const LONGEST = 100;
/** The number of outputs of a run without an analysis. */
export const OUTPUTS = 500;
/** A drag has moved the mechanism if a coordinate differs by more than this. */
const MOVED = 1e-6;

/** Drivers of one coordinate, with this coordinate and their law. */
export function driven(): { name: string; coordinate: string; value: Value }[] {
  return Object.entries(entries(tree.value, "drivers")).flatMap(([name, { coordinate, value }]) =>
    typeof coordinate === "string" && value !== undefined ? [{ name, coordinate, value }] : [],
  );
}

export async function quantityOf(name: string | undefined): Promise<number> {
  return name
    ? send("quantity", { name }).then(
        ({ ok }) => ok.value,
        () => 0,
      )
    : 0;
}

/** End and outputs of a motion: one turn of the crank, otherwise some seconds. */
export async function duration(): Promise<{ t_end: number; output_step: number }> {
  const rates = await Promise.all(
    driven().flatMap(({ coordinate }) => (coordinate.endsWith(".angle") ? [quantityOf(rateOf(coordinate))] : [])),
  );
  const turn = (2 * Math.PI) / Math.min(...rates.filter(Boolean).map(Math.abs), Number.POSITIVE_INFINITY);
  const t_end = turn > 0 && turn < LONGEST ? Number(turn.toPrecision(6)) : T_END;
  return { t_end, output_step: Number((t_end / OUTPUTS).toPrecision(6)) };
}

/** Give a case without an analysis the one that *Read* runs, so that the case can be run everywhere. */
export async function withAnalysis(): Promise<boolean> {
  const [type] = catalogue.value.analyses;
  if (!type || Object.keys(entries(tree.value, "analyses")).length || (mechanism.value?.bodies.length ?? 0) < 2)
    return false;
  const value: Tree = { type: type.name, ...(await duration()) };
  return change([{ path: ["analyses", freeName(tree.value, "run")], value }]);
}

/** The share of the way to a dead point that a motion goes. */
const BEFORE = 0.95;

/** Let an analysis end before the time at which it fails. */
export function endBefore(analysis: string, reached: number): Promise<boolean> {
  if (!(reached > 0)) return Promise.resolve(false);
  const t_end = Number((BEFORE * reached).toPrecision(3));
  const output_step = Number((t_end / OUTPUTS).toPrecision(6));
  const field = (name: string, value: Value): Change => ({ path: ["analyses", analysis, name], value });
  return change([field("t_end", t_end), field("output_step", output_step)]);
}

/** Whether a drag in *Move* has left the pose of the text. */
export function hasMoved(): boolean {
  return pose.value?.q.some((one, k) => Math.abs(one - home.value!.q[k]!) > MOVED) ?? false;
}

/** A number at the start of a law, with its unit. */
const BEGIN = /^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)(\s*\*\s*deg)?(?=\s*([-+]|$))/;

function shiftedLaw(law: Value, by: number): string {
  const text = String(law);
  const found = BEGIN.exec(text);
  const unit = found?.[2] ? Math.PI / 180 : 1;
  const begin = Number((Number(found?.[1] ?? 0) + by / unit).toPrecision(6));
  return found ? `${begin}${found[2] ?? ""}${text.slice(found[0].length)}` : `${begin} + ${text}`;
}

/** Let the laws of drivers begin at the shown pose, to which *Move* has brought the mechanism. */
export async function beginHere(): Promise<void> {
  const laws = driven();
  if (!laws.length || !hasMoved()) return;
  const now = await Promise.all(laws.map(({ coordinate }) => quantityOf(coordinate)));
  await send("pose", { q: home.value!.q });
  const before = await Promise.all(laws.map(({ coordinate }) => quantityOf(coordinate)));
  const changes = laws.flatMap(({ name, value }, k): Change[] => {
    const by = now[k]! - before[k]!;
    return Math.abs(by) > MOVED ? [{ path: ["drivers", name, "value"], value: shiftedLaw(value, by) }] : [];
  });
  if (await change(changes)) announce("info", texts.read.begun(laws.map(({ name }) => name).join(", ")));
}
