// Kinematics over a quantity, which replaces the time: the quantity and the range that the user chooses.
import { computed, effect, signal } from "@preact/signals";
import { entries } from "../catalogue/tree";
import type { Quantity } from "../core/protocol";
import { displayed, LENGTHS } from "../draw/display";
import { mechanism, mobility, openings, tree, units } from "../store/state";

/** An additional choice beside the analyses of the case. It has spaces, and names of analyses have none. */
export const OVER = "over a quantity";
/** The variable of runs over time. */
export const TIME: Quantity = { name: "t", unit: "s" };

/** The quantities of the mechanism that a run may follow. */
export const positions = signal<Quantity[]>([]);
const chosen = signal("");
/** First and last value, as typed; null for a whole turn. */
const written = signal<[string, string] | null>(null);

/** The coordinates of drivers. */
const driven = computed(() =>
  Object.values(entries(tree.value, "drivers")).flatMap(({ coordinate }) =>
    typeof coordinate === "string" ? [coordinate] : [],
  ),
);

/** Offer the position quantities of bodies and elements, first those of drivers and of links that turn fully. */
export function offer(all: Quantity[]): void {
  const turning = (mobility.value?.four_bars ?? []).flatMap((one) =>
    (one.turning ?? []).map((body) => `${body}.angle`),
  );
  const angles = (mechanism.value?.coordinates ?? []).filter((name) => name.endsWith(".angle"));
  const first = [...driven.value, ...turning, ...angles];
  const rank = (name: string) => (first.includes(name) ? first.indexOf(name) : first.length);
  const own = all.filter(({ name, unit }) => /^(m|rad)$/.test(unit) && name.split(".").length === 2);
  positions.value = own.sort((a, b) => rank(a.name) - rank(b.name));
}

/** The quantity that a requested run follows. */
export const over = computed<Quantity | undefined>(
  () => positions.value.find(({ name }) => name === chosen.value) ?? positions.value[0],
);

export function follow(name: string): void {
  chosen.value = name;
  written.value = null;
}

/** The unit in which the range is written. */
export const unit = computed(() => displayed(over.value?.unit ?? "", units.value).unit);

/** The shown range. For a length, it is empty until the user types it. */
export const range = computed<[string, string]>(() => {
  if (written.value) return written.value;
  if (over.value?.unit !== "rad") return ["", ""];
  return unit.value === "°" ? ["0", "360"] : ["0", "2*pi"];
});

export function writeRange(side: 0 | 1, text: string): void {
  const [first, last] = range.value;
  written.value = side === 0 ? [text, last] : [first, text];
}

/** The range in the notation of the core; null if an end is missing. */
export function rangeOfCore(): [string, string] | null {
  const inUnit = (text: string) =>
    unit.value === "°" ? `(${text})*deg` : unit.value === "mm" ? `(${text})/${LENGTHS.mm}` : text;
  const [first, last] = range.value.map((text) => text.trim());
  return first && last ? [inUnit(first), inUnit(last)] : null;
}

effect(() => {
  units.value;
  openings.value;
  written.value = null;
});
