// Passes pointer and wheel to the mode, or moves and zooms the sheet.
import { placeOn, spreadOf, turned } from "../plane/gestures";
import { distance, type Point } from "../plane/points";
import type { View } from "../plane/view";
import type { Handler, Spot } from "./handler";

/** A press with less motion than this is a click, px. */
const STILL = 5;
/** A finger that rests for this time opens the menu, ms. */
const LONG = 550;

export function listenToPointer(
  canvas: HTMLCanvasElement,
  view: View,
  handler: () => Handler,
  changed: () => void,
  menu: (spot: Spot) => void,
): void {
  const fingers = new Map<number, Point>();
  let began: Point = [0, 0];
  let still = true;
  let taken: Handler | null = null;
  let long: ReturnType<typeof setTimeout> | undefined;
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
    if (event.pointerType === "touch") {
      long = setTimeout(() => {
        if (!still || fingers.size !== 1) return;
        drop();
        fingers.clear();
        menu(spot(event));
      }, LONG);
    }
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) {
      handler().hover?.(spot(event));
      canvas.style.cursor = handler().cursor?.() ?? "grab";
      return;
    }
    if (distance(began, place(event)) > STILL) still = false;
    if (!still) clearTimeout(long);
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
  canvas.addEventListener("contextmenu", (event) => {
    event.preventDefault();
    clearTimeout(long);
    drop();
    fingers.clear();
    menu(spot(event));
  });
  canvas.addEventListener("pointerup", (event) => {
    clearTimeout(long);
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
