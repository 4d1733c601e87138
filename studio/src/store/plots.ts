// The plotted quantities.
import { effect, signal } from "@preact/signals";
import type { Stored } from "../give/stored";
import { course, quantities, variable } from "../modes/read";
import { moving } from "../plot/moving";
import { loads, mechanism, openings, scene } from "./state";

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

/** The first run of a case plots bodies that move. Later runs keep the plotted quantities that still exist. */
effect(() => {
  if (!course.value || !quantities.value.length) return;
  const all = new Set(quantities.value.map(({ name }) => name));
  const kept = plots
    .peek()
    .map((one) => ({ ...one, names: one.names.filter((name) => all.has(name)) }))
    .filter(({ names }) => names.length);
  if (kept.length) plots.value = kept;
  else plots.value = [{ key: 1, names: firstOf(course.value, all) }];
});

/** The angles of some bodies that turn, otherwise the coordinate of a body that shifts. */
function firstOf({ rows, width }: { rows: Float64Array; width: number }, all: ReadonlySet<string>): string[] {
  const bodies = mechanism.peek()?.bodies.slice(1) ?? [];
  const [x0, y0, x1, y1] = scene.peek()?.bounds ?? [0, 0, 1, 1];
  const names = bodies.flatMap(({ name }) => ["x", "y", "angle"].map((part) => `${name}.${part}`));
  const offered = (k: number) => all.has(names[k]!) && names[k] !== variable.peek().name;
  const found = moving(rows, width, Math.hypot(x1 - x0, y1 - y0), offered);
  return found.length ? found.map((k) => names[k]!) : [...all].slice(0, 1);
}
