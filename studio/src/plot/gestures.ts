// Pointer, wheel and keys in a plot: they choose a time, read values at a time, and stretch the axis.
import { placeOn, spreadOf, turned } from "../plane/gestures";
import type { Point } from "../plane/points";

/** The actions of gestures in a plot. Places are px from its left edge. */
export interface Seeking {
  timeAt(px: number): number;
  seek(t: number): void;
  look(at: Point | null): void;
  /** Multiply the visible part by `factor` around a place. */
  stretch(factor: number, px: number): void;
  showAll(): void;
}

const STEP = 1.25;

/**
 * Connect the gestures of a plot: a click or drag goes to a time, and the pointer reads values. Ctrl and wheel, two
 * fingers, + and − stretch the axis; a double click or 0 shows all of it. Returns a function that disconnects them.
 */
export function seekable(canvas: HTMLCanvasElement, seeking: Seeking): () => void {
  const { timeAt, seek, look, stretch, showAll } = seeking;
  const fingers = new Map<number, Point>();
  const ending = new AbortController();
  const on = <Kind extends keyof HTMLElementEventMap>(kind: Kind, act: (event: HTMLElementEventMap[Kind]) => void) =>
    canvas.addEventListener(kind, act, { passive: false, signal: ending.signal });
  const go = (event: PointerEvent) => seek(timeAt(placeOn(canvas, event)[0]));
  on("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, placeOn(canvas, event));
    if (fingers.size === 1) go(event);
  });
  on("pointermove", (event) => {
    if (event.pointerType !== "touch") look(placeOn(canvas, event));
    if (!fingers.has(event.pointerId)) return;
    const before = spreadOf(fingers);
    fingers.set(event.pointerId, placeOn(canvas, event));
    const after = spreadOf(fingers);
    if (fingers.size === 1) go(event);
    else if (before.width > 0 && after.width > 0) stretch(before.width / after.width, after.middle[0]);
  });
  const lift = (event: PointerEvent) => fingers.delete(event.pointerId);
  on("pointerup", lift);
  on("pointercancel", lift);
  on("pointerleave", () => look(null));
  on("wheel", (event) => {
    if (!event.ctrlKey) return; // the wheel alone scrolls the list of plots
    event.preventDefault();
    stretch(1 / turned(event), placeOn(canvas, event)[0]);
  });
  on("dblclick", showAll);
  on("keydown", (event) => withKey(event, canvas.clientWidth / 2, seeking));
  return () => ending.abort();
}

/** A plot that has the focus keeps the keys that stretch it. */
function withKey(event: KeyboardEvent, middle: number, { stretch, showAll }: Seeking): void {
  if (event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key === "+" || event.key === "=") stretch(1 / STEP, middle);
  else if (event.key === "-") stretch(STEP, middle);
  else if (event.key === "0") showAll();
  else return;
  event.preventDefault();
  event.stopPropagation();
}
