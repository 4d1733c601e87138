// The first visit: a mechanism moves, and one line says what to drag.
import { computed, effect, signal } from "@preact/signals";
import { mode, openings, shown } from "./state";

/** The name in the storage of the browser. */
const KEY = "kempe.visited";
/** The opened case with the line; null without one. */
const greeted = signal<number | null>(null);

/** Whether the browser remembers no visit; it remembers this one. Without a storage, no visit is the first one. */
export function isFirstVisit(): boolean {
  try {
    const found = localStorage.getItem(KEY) === null;
    localStorage.setItem(KEY, "1");
    return found;
  } catch {
    return false;
  }
}

/** Whether the line is shown: as long as the case is shown in *Live*. */
export const greets = computed(() => mode.value === "live" && greeted.value === openings.value);

/** Show the line, and the drawing without names and numbers. */
export function greet(): void {
  const before = shown.value;
  greeted.value = openings.value;
  shown.value = { ...before, names: false, numbers: false };
  const end = effect(() => {
    if (greets.value) return;
    shown.value = before;
    queueMicrotask(() => end());
  });
}
