// One arrow.

/** A straight arrow with a solid head. */
export function paintArrow(context, [x0, y0], [x1, y1], colour, width) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (!(length > 0)) return;
  const head = Math.min(4 + 2.4 * width, 0.6 * length);
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const [bx, by] = [x1 - head * ux, y1 - head * uy];
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = width;
  context.stroke(new Path2D(`M${x0} ${y0}L${bx} ${by}`));
  const wing = 0.42 * head;
  const tip = new Path2D(`M${x1} ${y1}L${bx - wing * uy} ${by + wing * ux}L${bx + wing * uy} ${by - wing * ux}z`);
  context.fill(tip);
  if (width > 4) context.stroke(tip);
}

/** Two strokes across an arrow that is drawn shorter than its value. */
export function paintBreak(context, [x0, y0], [x1, y1], colour, background) {
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 24) return;
  const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
  const [mx, my] = [x0 + 0.45 * (x1 - x0), y0 + 0.45 * (y1 - y0)];
  const stroke = (at) => `M${mx + at * ux - 5 * (uy - 0.4 * ux)} ${my + at * uy + 5 * (ux + 0.4 * uy)}l${10 * (uy - 0.4 * ux)} ${-10 * (ux + 0.4 * uy)}`;
  for (const [paint, width] of [[background, 6], [colour, 1.6]]) {
    context.strokeStyle = paint;
    context.lineWidth = width;
    context.stroke(new Path2D(stroke(-2.5) + stroke(2.5)));
  }
}
