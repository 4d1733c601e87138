// The first build guides the user through a four-bar linkage, step by step.
import { computed, effect, signal } from "@preact/signals";
import { EMPTY } from "../give/files";
import { enter } from "../modes/modes";
import { restart } from "../modes/place";
import { take } from "../store/document";
import { quiet } from "../store/hints";
import { fitNext } from "../store/sheet";
import { dialog, mechanism, mode, panel, selection, tool, tools } from "../store/state";
import { type Ghost, STEPS } from "./steps";

/** The number of the present step; null while the guide is off. */
export const at = signal<number | null>(null);
export const step = computed(() => (at.value === null ? null : (STEPS[at.value] ?? null)));

/** The tool of the present step. */
export const tooled = computed(() => tools.value.find((one) => step.value?.tool?.(one)) ?? null);

/** The next part of the step: choose its mode, choose its tool, or click on the sheet. */
export const phase = computed<"mode" | "tool" | "sheet">(() => {
  if (step.value && mode.value !== step.value.mode) return "mode";
  return tooled.value && tool.value?.type !== tooled.value.type ? "tool" : "sheet";
});

/** The marks on the sheet. */
export const ghost = computed<Ghost | null>(() =>
  step.value && mode.value === step.value.mode ? step.value.ghost() : null,
);

/** Whether the sheet is empty. */
export const blank = computed(() => {
  const bodies = mechanism.value?.bodies;
  return bodies?.length === 1 && !Object.keys(bodies[0]!.points).length;
});

/** Start on an empty sheet. Undo restores the previous text. */
export async function begin(): Promise<void> {
  dialog.value = null;
  enter("edit");
  restart(null);
  selection.value = null;
  panel.value = "properties";
  if (!blank.value) {
    fitNext();
    await take(EMPTY);
  }
  at.value = 0;
}

export function skip(): void {
  if (at.value !== null) at.value = at.value + 1 < STEPS.length ? at.value + 1 : null;
}

export function leave(): void {
  at.value = null;
}

/** Switch hints off while the card explains the step. */
effect(() => {
  quiet.value = step.value !== null;
});

/** Continue with the next step when a step is done. */
effect(() => {
  if (step.value?.done()) skip();
});
