// Passes pointer and wheel to the mode, or moves and zooms the sheet.
import { placeOn, spreadOf, turned } from "../plane/gestures";
import { distance, type Point } from "../plane/points";
import type { View } from "../plane/view";
import type { Handler, Spot } from "./handler";

/** A press with less motion than this is a click, px. */
const STILL = 5;

export function listenToPointer(
  canvas: HTMLCanvasElement,
  view: View,
  handler: () => Handler,
  changed: () => void,
): void {
  const fingers = new Map<number, Point>();
  let began: Point = [0, 0];
  let still = true;
  let taken: Handler | null = null;
  const place = (event: MouseEvent) => placeOn(canvas, event);
  const spot = (event: PointerEvent | MouseEvent): Spot => {
    const px = place(event);
    const touch = "pointerType" in event && event.pointerType === "touch";
    return { px, at: view.toPlane(px), touch, free: event.altKey || event.ctrlKey };
  };
  const drop = () => {
    taken?.cancel?.();
    taken = null;
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 && event.button !== 1) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    if (fingers.size > 1) {
      drop();
      still = false;
      return;
    }
    [began, still] = [place(event), true];
    if (event.button === 0 && handler().down?.(spot(event))) taken = handler();
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) {
      handler().hover?.(spot(event));
      canvas.style.cursor = handler().cursor?.() ?? "grab";
      return;
    }
    if (distance(began, place(event)) > STILL) still = false;
    const spread = spreadOf(fingers);
    fingers.set(event.pointerId, place(event));
    if (fingers.size === 1 && taken) {
      if (!still) taken.drag?.(spot(event));
      return;
    }
    if (still) return;
    view.follow(spread, spreadOf(fingers));
    changed();
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!fingers.delete(event.pointerId)) return;
    const one = taken;
    taken = null;
    if (still) {
      one?.cancel?.();
      handler().click?.(spot(event));
    } else one?.up?.(spot(event));
  });
  canvas.addEventListener("pointercancel", (event) => {
    fingers.delete(event.pointerId);
    drop();
  });
  canvas.addEventListener("pointerleave", () => handler().hover?.(null));
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      view.zoom(turned(event), place(event));
      changed();
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", (event) => {
    if (handler().double?.(spot(event))) return;
    view.fit();
    changed();
  });
}
