// The common state of all plots of the page: their horizontal axis, its visible part, and the time under the pointer.
import { computed, effect, signal } from "@preact/signals";
import { displayed } from "../draw/display";
import { onAxis, type Stored } from "../give/stored";
import type { Across, Curve } from "../plot/curve";
import type { Plot } from "../plot/plot";
import { straight } from "../plot/straight";
import { TimeSpan } from "../plot/timespan";
import { plots, stored } from "../store/plots";
import { units } from "../store/state";
import { condition, course, quantities, span, variable } from "./read";

/** The drawn plots by their keys. */
export const drawn = new Map<number, Plot>();
/** The time under the pointer, or null. */
export const looked = signal<number | null>(null);
/** Counts changes of the visible part. */
export const stretched = signal(0);

export const across = computed<Across>(() => {
  const { name, unit } = variable.value;
  const { factor, unit: shown } = displayed(unit, units.value);
  return { name, shown, divisor: 1 / factor, condition: condition.value };
});

/** The plotted curves of the stored run that have a place on the axis. */
const besides = computed(() => {
  const other = stored.value;
  if (!other) return [];
  const names = plots.value.flatMap((one) => one.names);
  return names.flatMap((name) => onAxis(other, variable.value, { name, unit: unitOf(name) }) ?? []);
});

function unitOf(name: string): string {
  return quantities.value.find((one) => one.name === name)?.unit ?? "";
}

/** The ends of the interval that contains the present run and the drawn curves of the stored run. */
const ends = computed(() => {
  let [begin, end] = span.value;
  for (const { t } of besides.value) [begin, end] = [Math.min(begin, t[0]!), Math.max(end, t.at(-1)!)];
  return { begin, end };
});

export const shownSpan = computed(() => {
  course.value;
  return new TimeSpan(ends.value);
});

effect(() => {
  shownSpan.value;
  looked.value = null;
});

/** The curves of a plot: those of the run, then those of the stored run. */
export function curvesOf(names: readonly string[], units: readonly string[], rows: readonly Float64Array[]): Curve[] {
  const t = course.peek()?.t ?? new Float64Array();
  const of = (k: number) => ({ name: names[k]!, unit: units[k] ?? "", number: k });
  const present = rows.map((values, k) => straight({ ...of(k), stored: false, t, values }));
  return [...present, ...names.flatMap((_, k) => storedCurve(stored.value, of(k)))];
}

function storedCurve(other: Stored | null, of: Pick<Curve, "name" | "unit" | "number">): Curve[] {
  const found = other && onAxis(other, variable.peek(), of);
  return found ? [straight({ ...of, stored: true, t: found.t, values: found.row })] : [];
}

/** Whether the stored run is over another variable than the present run. */
export const hasOtherAxis = computed(() => {
  const other = stored.value?.variable.name;
  return other !== undefined && other !== variable.value.name;
});
