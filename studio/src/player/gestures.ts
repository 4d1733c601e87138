// Pointer and wheel: moving and zooming the drawing, going to a time in the plot.
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

/** What gestures in a plot do; places are px from its left edge. */
export interface Seeking {
  timeAt(px: number): number;
  seek(t: number): void;
  look(at: Point | null): void;
  stretch(factor: number, px: number): void;
  showAll(): void;
}

/**
 * Click or drag in a plot to go to a time, move to look at one, ctrl and wheel (or two fingers on a
 * touchpad) to stretch it, double click to show all of it.
 */
export function seekable(canvas: HTMLCanvasElement, { timeAt, seek, look, stretch, showAll }: Seeking): void {
  const go = (event: PointerEvent) => seek(timeAt(placeOn(canvas, event)[0]));
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    go(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) go(event);
    if (event.pointerType !== "touch") look(placeOn(canvas, event));
  });
  canvas.addEventListener("pointerleave", () => look(null));
  const zoom = (event: WheelEvent) => {
    if (!event.ctrlKey) return; // the wheel alone scrolls the list of plots
    event.preventDefault();
    stretch(1 / turned(event), placeOn(canvas, event)[0]);
  };
  canvas.addEventListener("wheel", zoom, { passive: false });
  canvas.addEventListener("dblclick", showAll);
}
