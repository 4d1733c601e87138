// The note beside the pointer: what a drag changes, or why something is not possible, and other choices.
import { signal } from "@preact/signals";
import type { Point } from "../plane/points";

export interface Note {
  /** The place of the pointer, px in the canvas. */
  at: Point;
  text: string;
  kind?: "lock" | "wrong";
  actions?: { label: string; run(): void }[];
}

export const note = signal<Note | null>(null);
