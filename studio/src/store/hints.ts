// Hints at the first use of a mode or a kind of tool.
import { computed, effect, signal } from "@preact/signals";
import type { texts } from "../texts";
import { mode, tool } from "./state";

export type Hint = keyof typeof texts.hints.all;

/** The name in the storage of the browser. */
const KEY = "kempe.hints";
/** The hints that were shown. A page without storage keeps them until it is closed. */
const seen = signal<ReadonlySet<string>>(new Set(remembered()));
/** True while the first build explains the next step. */
export const quiet = signal(false);

/** The mode or kind of tool in use. */
const used = computed<Hint>(() => {
  if (mode.value !== "edit") return mode.value;
  const placing = tool.value?.placing;
  if (placing === "slider" || placing === "cylinder") return "two";
  return tool.value ? (placing ?? "reference") : "edit";
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

/** A hint counts as shown when the user changes the mode or the tool. */
let last: Hint | null = null;
effect(() => {
  const now = hint.value;
  if (last && last !== used.value) dismiss(last);
  last = now;
});
