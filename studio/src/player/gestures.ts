// Pointer and wheel: moving and zooming the drawing.
import { placeOn, spreadOf, turned } from "../plane/gestures";
import type { Point } from "../plane/points";
import type { View } from "../plane/view";

/** Drag to move, wheel or two fingers to zoom, double click to show everything. */
export function movable(canvas: HTMLCanvasElement, view: View, changed: () => void): void {
  const fingers = new Map<number, Point>();
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, placeOn(canvas, event));
    canvas.classList.add("dragged");
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = spreadOf(fingers);
    fingers.set(event.pointerId, placeOn(canvas, event));
    view.follow(before, spreadOf(fingers));
    changed();
  });
  const lift = (event: PointerEvent) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) canvas.classList.remove("dragged");
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  const zoom = (event: WheelEvent) => {
    event.preventDefault();
    view.zoom(turned(event), placeOn(canvas, event));
    changed();
  };
  canvas.addEventListener("wheel", zoom, { passive: false });
  canvas.addEventListener("dblclick", () => {
    view.fit();
    changed();
  });
}
