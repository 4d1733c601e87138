// The menu at a place of the sheet.
import { signal } from "@preact/signals";
import type { Point } from "../plane/points";

/** What is possible there, or why it is not. */
export interface Entry {
  label: string;
  run?: () => void;
  why?: string;
}

export const menu = signal<{ at: Point; title: string; entries: Entry[] } | null>(null);
