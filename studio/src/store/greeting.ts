// The first visit: a mechanism moves, and one line says what to drag.
import { computed, signal } from "@preact/signals";
import { mode, openings } from "./state";

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

/** Show the line as long as the case is shown in *Live*. */
export function greet(): void {
  greeted.value = openings.value;
}

export const greets = computed(() => mode.value === "live" && greeted.value === openings.value);
