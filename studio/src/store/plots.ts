// The plotted quantities.
import { effect, signal } from "@preact/signals";
import type { Stored } from "../give/stored";
import { course, quantities, variable } from "../modes/read";
import { loads, openings } from "./state";

export interface PlotOf {
  key: number;
  names: string[];
}

/** A stored run whose curves are drawn beside those of the present one. */
export const stored = signal<Stored | null>(null);
export const plots = signal<PlotOf[]>([]);

let opening = 0;

/**
 * Remove the plots and the stored run when another case is opened. This waits until the core has read the case, because
 * earlier runs belong to the previous case.
 */
effect(() => {
  loads.value;
  if (openings.peek() !== opening) {
    plots.value = [];
    stored.value = null;
  }
  opening = openings.peek();
});

/** The first run of a case plots the angles of the bodies. Later runs keep the plotted quantities that still exist. */
effect(() => {
  if (!course.value || !quantities.value.length) return;
  const all = new Set(quantities.value.map(({ name }) => name));
  const kept = plots
    .peek()
    .map((one) => ({ ...one, names: one.names.filter((name) => all.has(name)) }))
    .filter(({ names }) => names.length);
  if (kept.length) plots.value = kept;
  else plots.value = [{ key: 1, names: firstOf(quantities.value.map(({ name, unit }) => ({ name, unit }))) }];
});

const MOST = 3;

function firstOf(all: { name: string; unit: string }[]): string[] {
  const unit = all.some((one) => one.unit === "rad") ? "rad" : all[0]!.unit;
  const first = all.filter((one) => one.unit === unit).slice(0, MOST);
  const others = first.filter(({ name }) => name !== variable.value.name);
  return (others.length ? others : first).map(({ name }) => name);
}
