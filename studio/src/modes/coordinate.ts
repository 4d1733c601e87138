// The coordinate that a click on a body or element selects.
import type { Quantity, Triple } from "../core/protocol";
import { CoreError } from "../core/transport";
import type { Motion } from "../edit/driving";
import { rateOf } from "../edit/start";
import { goHome, send } from "../store/session";
import { mechanism, mobility, pose, unassembled } from "../store/state";

/**
 * The first position quantity of a body or element that can move, angles before lengths. If none can move, the first of
 * all with `fixed`, otherwise null.
 */
export async function coordinateOf(owner: string | null, fixed: boolean): Promise<Motion | null> {
  if (!owner) return null;
  const own = await positionsOf(owner);
  const all = [...own.filter(({ unit }) => unit === "rad"), ...own.filter(({ unit }) => unit === "m")];
  const known = !unassembled.value && all.length > 0;
  const found = known ? await firstFree(owner, all) : all[0];
  const taken = found ?? (fixed ? all[0] : undefined);
  return taken ? motionOf(taken) : null;
}

/** Another position quantity of a body or element, if possible with the unit of those before. */
export async function alikeOf(owner: string | null, before: readonly Motion[]): Promise<Motion | null> {
  if (!owner) return null;
  const own = await positionsOf(owner);
  const found = own.find(({ unit }) => unit === before[0]?.unit) ?? own[0];
  return found && !before.some(({ name }) => name === found.name) ? motionOf(found) : null;
}

async function positionsOf(owner: string): Promise<Quantity[]> {
  const { ok } = await send("quantities", {});
  return ok.filter(
    ({ name, unit }) => name.startsWith(`${owner}.`) && name.split(".").length === 2 && /^(rad|m)$/.test(unit),
  );
}

async function motionOf(one: Quantity): Promise<Motion> {
  const read = async (name: string | undefined) => (name ? (await send("quantity", { name })).ok.value : 0);
  const [value, rate] = await Promise.all([read(one.name), read(rateOf(one.name))]);
  return { ...one, value, rate, alone: mobility.value?.degrees_of_freedom === 1 };
}

/** The first quantity to which the mechanism can give a rate in its present pose. */
async function firstFree(owner: string, all: Quantity[]): Promise<Quantity | undefined> {
  const names = mechanism.value?.coordinates ?? [];
  const guess = Object.fromEntries(names.map((name, k) => [name, pose.value?.q[k] ?? 0]));
  try {
    for (const one of all) {
      const rate = rateOf(one.name);
      if (!rate) return one;
      const rates = await ratesAt(owner, rate, guess);
      if (!rates) continue;
      // Along a steep guide, y moves more than x.
      const steep = one.name.endsWith(".x") && Math.abs(rates[1]) > Math.abs(rates[0]);
      return (steep && all.find(({ name }) => name === `${owner}.y`)) || one;
    }
    return undefined;
  } finally {
    await goHome();
  }
}

/** The velocities of a body where a rate is 1, null if the joints and drivers do not allow it. */
async function ratesAt(owner: string, rate: string, guess: Record<string, number>): Promise<Triple | null> {
  const k = (mechanism.value?.bodies ?? []).findIndex(({ name }) => name === owner);
  try {
    const { ok } = await send("assemble", { set: { [rate]: 1 }, guess });
    return ok.rates[k - 1] ?? [0, 0, 0];
  } catch (error) {
    if (error instanceof CoreError) return null;
    throw error;
  }
}
