// The meaning of a typed text: the core reads it.
import type { Loaded, Problem, Value } from "../core/protocol";
import { LENGTHS } from "../draw/display";
import { send } from "../store/session";
import { announce, text, tree, units } from "../store/state";
import { texts } from "../texts";
import { typed, written } from "./values";

export type Meaning<T> = { value: T } | { problem: Problem };

/** Let the core read another text, and then the text of the case again. No other request comes between the two. */
async function readApart(given: string): Promise<Loaded> {
  const found = send("load", { text: given });
  const back = send("load", { text: text.value });
  return (await Promise.all([found, back]))[0].ok;
}

/** A length in m: a number in the unit of the display, a number with its unit, or a formula in the parameters of the case. */
export async function lengthMeant(given: string): Promise<Meaning<number>> {
  const short = typed(given);
  const metre = LENGTHS[units.value.length];
  const found = typeof short === "string" ? await formulaMeant(short) : { value: Number(short ?? 0) / metre };
  if (!("value" in found)) return found;
  return typeof found.value === "number" && found.value > 0 && Number.isFinite(found.value)
    ? { value: found.value }
    : { problem: { message: texts.edit.noLength(units.value.length) } };
}

async function formulaMeant(given: string): Promise<Meaning<Value>> {
  const parameters = written(tree.value?.parameters ?? {});
  const ground = { points: { P: [given, 0] } };
  const { mechanism, problems } = await readApart(
    `kempe = 1\nparameters = ${parameters}\nbodies = ${written({ ground })}\n`,
  );
  const place = mechanism?.bodies[0]?.points.P;
  return place ? { value: place[0] } : { problem: problems[0] ?? { message: texts.edit.noLength(units.value.length) } };
}

/** A value in the notation of the file, such as a list or a table. */
export async function notationMeant(given: string): Promise<Meaning<Value>> {
  const { case: found, problems } = await readApart(`kempe = 1\nvalue = ${given.replace(/\s*\n\s*/g, " ")}\n`);
  const value = found?.value;
  if (value !== undefined && value !== null) return { value };
  return { problem: problems[0] ?? { message: texts.edit.noNotation } };
}

/** The value of a meaning. A problem is shown; the value is then undefined. */
export function meantValue<T>(found: Meaning<T>): T | undefined {
  if ("value" in found) return found.value;
  const { message, hint } = found.problem;
  announce("problem", message, hint ? { hint } : {});
  return undefined;
}
