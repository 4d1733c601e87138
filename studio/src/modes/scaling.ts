// Scaling the picture behind the drawing: two clicks, then their distance.
import type { Point } from "../plane/points";
import { backdrop, scaling, shifting } from "../store/backdrop";
import { preview } from "../store/sheet";
import { announce, message } from "../store/state";
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
    else endMessage();
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
  shifting.value = false;
  preview.value = null;
  endMessage();
}

/** Remove the message about the clicks, which are done. */
function endMessage(): void {
  const { first, second } = texts.picture;
  if ([first, second].some((one) => one === message.value?.text)) message.value = null;
}

let from: Point | null = null;

/** Drags move the picture. */
export const shift: Handler = {
  down({ at }) {
    from = at;
    return true;
  },
  drag({ at }) {
    const found = backdrop.value;
    if (!found || !from) return;
    const [x, y] = found.center;
    backdrop.value = { ...found, center: [x + at[0] - from[0], y + at[1] - from[1]] };
    from = at;
  },
  cursor: () => "move",
};

export function removeBackdrop(): void {
  endScaling();
  backdrop.value = null;
}
