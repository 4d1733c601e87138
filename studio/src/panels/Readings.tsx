// Quantities of the selection at the shown pose.
import { useEffect, useState } from "preact/hooks";
import type { Group } from "../catalogue/catalogue";
import { displayed, LENGTHS } from "../draw/display";
import { significant, withUnit } from "../draw/numbers";
import { placed } from "../plane/points";
import { send } from "../store/session";
import { mechanism, pose, poses, units } from "../store/state";
import { texts } from "../texts";
import { Facts, Section } from "./parts";

/** The time between two readings during a motion, ms. */
const PAUSE = 120;
const MOST = 14;

export function Readings({ group, name }: { group: Group; name: string }) {
  const [rows, setRows] = useState<[string, string][]>([]);
  const now = pose.value;
  useEffect(() => {
    let current = true;
    const timer = setTimeout(() => {
      void readings(name)
        .then((found) => current && setRows(found))
        .catch(() => current && setRows([]));
    }, PAUSE);
    return () => {
      current = false;
      clearTimeout(timer);
    };
  }, [name, now]);
  const length = group === "bodies" ? lengthOf(name) : "";
  const own: [string, string][] = length
    ? [[texts.properties.length, `${length} ${units.value.length}`], ...rows]
    : rows;
  return own.length ? (
    <Section title={texts.properties.results}>
      <Facts rows={own} />
    </Section>
  ) : null;
}

async function readings(name: string): Promise<[string, string][]> {
  const { ok } = await send("quantities", {}, "readings");
  const own = ok.filter((one) => one.name.startsWith(`${name}.`) && one.name.split(".").length === 2).slice(0, MOST);
  const values = await Promise.allSettled(own.map((one) => send("quantity", { name: one.name })));
  return own.flatMap(({ name: full }, k): [string, string][] => {
    const found = values[k]!;
    if (found.status === "rejected") return [];
    return [[full.slice(name.length + 1), shown(found.value.ok.value, found.value.ok.unit)]];
  });
}

/** A value in display units. */
export function shown(value: number | null, unit: string): string {
  if (value === null || !Number.isFinite(value)) return texts.properties.absent;
  const tidy = Math.abs(value) < 1e-12 ? 0 : value;
  const { factor, unit: own } = displayed(unit, units.value);
  return withUnit(tidy * factor, own);
}

/** The distance of the first two points of a moving body in the unit of the display; empty without them. */
export function lengthOf(name: string): string {
  const bodies = mechanism.value?.bodies ?? [];
  const k = bodies.findIndex((body) => body.name === name);
  const place = poses.value[k];
  const [a, b] = Object.values(bodies[k]?.points ?? {}).map((at) => place && placed(place, at));
  if (!a || !b || bodies[k]!.ground) return "";
  return significant(Math.hypot(a[0] - b[0], a[1] - b[1]) * LENGTHS[units.value.length], 6);
}
