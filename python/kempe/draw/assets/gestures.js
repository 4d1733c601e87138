// Pointer and wheel: moving and zooming the drawing, going to a time in the plot.

/** Drag to move, wheel or two fingers to zoom, double click to show everything. */
export function movable(canvas, view, changed) {
  const fingers = new Map();
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, place(event));
    canvas.classList.add("dragged");
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    const before = spread(fingers);
    fingers.set(event.pointerId, place(event));
    const after = spread(fingers);
    view.pan(after.middle[0] - before.middle[0], after.middle[1] - before.middle[1]);
    if (before.width > 0 && after.width > 0) view.zoom(after.width / before.width, after.middle);
    changed();
  });
  const lift = (event) => {
    fingers.delete(event.pointerId);
    if (!fingers.size) canvas.classList.remove("dragged");
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    view.zoom(turned(event), place(event));
    changed();
  }, { passive: false });
  canvas.addEventListener("dblclick", () => {
    view.fit();
    changed();
  });
}

/** Middle of the fingers and the distance between the first two, px. */
function spread(fingers) {
  const places = [...fingers.values()];
  const middle = [0, 1].map((k) => places.reduce((sum, at) => sum + at[k], 0) / places.length);
  const [a, b] = places;
  return { middle, width: b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0 };
}

/** How much a turn of the wheel magnifies. */
function turned({ deltaY, deltaMode }) {
  const pixels = deltaY * (deltaMode === 1 ? 16 : 1);
  return Math.exp(-Math.max(-200, Math.min(200, pixels)) / 400);
}

/**
 * Click or drag in a plot to go to a time, move to look at one, ctrl and wheel (or two fingers on a
 * touchpad) to stretch it, double click to show all of it.
 */
export function seekable(canvas, { timeAt, seek, look, stretch, showAll }) {
  const place = (event) => {
    const { left, top } = canvas.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  };
  const go = (event) => seek(timeAt(place(event)[0]));
  canvas.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    canvas.setPointerCapture(event.pointerId);
    go(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (canvas.hasPointerCapture(event.pointerId)) go(event);
    if (event.pointerType !== "touch") look(...place(event));
  });
  canvas.addEventListener("pointerleave", () => look(null));
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return; // the wheel alone scrolls the list of plots
    event.preventDefault();
    stretch(1 / turned(event), place(event)[0]);
  }, { passive: false });
  canvas.addEventListener("dblclick", showAll);
}
