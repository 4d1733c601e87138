// Pointer and wheel: a mode takes them, or they move and zoom the sheet.
import { distance, type Point } from "../plane/points";
import type { View } from "../plane/view";
import type { Handler, Spot } from "./handler";

/** A press that moves less than this is a click, px. */
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
  const place = (event: MouseEvent): Point => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
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
    const after = spreadOf(fingers);
    view.pan(after.middle[0] - spread.middle[0], after.middle[1] - spread.middle[1]);
    if (spread.width > 0 && after.width > 0) view.zoom(after.width / spread.width, after.middle);
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

/** Middle of the fingers and the distance between the first two, px. */
function spreadOf(fingers: Map<number, Point>): { middle: Point; width: number } {
  const places = [...fingers.values()];
  const middle = [0, 1].map((k) => places.reduce((sum, at) => sum + at[k]!, 0) / places.length) as Point;
  const [a, b] = places;
  return { middle, width: a && b ? distance(a, b) : 0 };
}

/** How much a turn of the wheel magnifies. */
function turned({ deltaY, deltaMode }: WheelEvent): number {
  const pixels = deltaY * (deltaMode === 1 ? 16 : 1);
  return Math.exp(-Math.max(-200, Math.min(200, pixels)) / 400);
}
