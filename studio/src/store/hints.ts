// Hints for what is used for the first time: the modes, and the kinds of tools.
import { computed, effect, signal } from "@preact/signals";
import type { texts } from "../texts";
import { mode, tool } from "./state";

export type Hint = keyof typeof texts.hints.all;

/** The name in the storage of the browser. */
const KEY = "kempe.hints";
/** Hints that were shown; a page without storage remembers them until it is closed. */
const seen = signal<ReadonlySet<string>>(new Set(remembered()));
/** Set while something else explains the next step. */
export const quiet = signal(false);

/** What is used now. */
const used = computed<Hint>(() => {
  if (mode.value !== "edit") return mode.value;
  return tool.value ? (tool.value.placing ?? "reference") : "edit";
});

export const hint = computed<Hint | null>(() => (quiet.value || seen.value.has(used.value) ? null : used.value));

/** Never show a hint again. */
export function dismiss(one: Hint): void {
  seen.value = new Set([...seen.peek(), one]);
  try {
    localStorage.setItem(KEY, JSON.stringify([...seen.peek()]));
  } catch {
    // A page from a disk may have no storage.
  }
}

function remembered(): string[] {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    return Array.isArray(found) ? found.filter((one) => typeof one === "string") : [];
  } catch {
    return [];
  }
}

/** A hint has been seen when something else is used. */
let last: Hint | null = null;
effect(() => {
  const now = hint.value;
  if (last && last !== used.value) dismiss(last);
  last = now;
});
