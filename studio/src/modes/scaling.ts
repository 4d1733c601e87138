// Scaling the picture behind the drawing: two clicks, then their distance.
import { backdrop, scaling } from "../store/backdrop";
import { preview } from "../store/sheet";
import { announce } from "../store/state";
import { texts } from "../texts";
import type { Handler } from "./handler";

export function beginScaling(): void {
  scaling.value = [];
  announce("info", texts.picture.first);
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
