// Scaling the picture behind the drawing: two clicks, then their distance.
import { backdrop, scaling } from "../store/backdrop";
import { preview } from "../store/sheet";
import { announce } from "../store/state";
import { texts } from "../texts";
import type { Handler } from "./handler";

export function beginScaling(): void {
  scaling.value = [];
  announce("info", texts.picture.first);
  document.getElementById("sheet")?.focus({ preventScroll: true }); // keys click, too
}

/** Whether a click is still awaited. */
export function awaitsClick(): boolean {
  return scaling.value !== null && scaling.value.length < 2;
}

export const scale: Handler = {
  down: () => true,
  click({ at }) {
    const points = scaling.value ?? [];
    if (points.length > 1) return;
    scaling.value = [...points, at];
    preview.value = { line: scaling.value, mark: { at, kind: "free" } };
    if (points.length === 0) announce("info", texts.picture.second);
  },
  hover(spot) {
    if (!awaitsClick()) return;
    const line = spot ? [...scaling.value!, spot.at] : scaling.value!;
    preview.value = line.length ? { line, mark: { at: line.at(-1)!, kind: "free" } } : null;
  },
  cursor: () => "crosshair",
};

export function endScaling(): void {
  scaling.value = null;
  preview.value = null;
}

export function removeBackdrop(): void {
  endScaling();
  backdrop.value = null;
}
