// A canvas that is as sharp as the screen, and the colours of the page.

/** Fit a canvas to its place; true if its size changed. */
export function sharpen(canvas) {
  const { width, height } = canvas.getBoundingClientRect();
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
  if (canvas.width === w && canvas.height === h) return false;
  canvas.width = w;
  canvas.height = h;
  return true;
}

/** A cleared drawing context in CSS pixels. */
export function cleared(canvas) {
  const context = canvas.getContext("2d");
  const { width, height } = canvas.getBoundingClientRect();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.setTransform(canvas.width / Math.max(1, width), 0, 0, canvas.height / Math.max(1, height), 0, 0);
  context.lineCap = "round";
  context.lineJoin = "round";
  return context;
}

const BODY_COLOURS = 7;
/** Lengths of strokes and gaps of the curves after the colours are used up, px. */
const DASHES = [[], [7, 4], [2, 4], [9, 3, 2, 3]];

/** The colours of a picture on white paper, whatever the page has. */
export function paperPalette() {
  document.documentElement.classList.add("paper");
  const found = palette();
  document.documentElement.classList.remove("paper");
  return found;
}

/** The colours of the page as they are now, light or dark. */
export function palette() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(`--${name}`).trim();
  const names = ["page", "panel", "edge", "text", "soft", "accent", "grid", "ground", "paper", "ink", "force", "drive", "quiet", "reactions", "velocities", "accelerations"];
  const colours = Object.fromEntries(names.map((name) => [name, read(name)]));
  const bodies = Array.from({ length: BODY_COLOURS }, (_, k) => read(`body-${k + 1}`));
  return { ...colours, body: (number) => (number ? bodies[(number - 1) % BODY_COLOURS] : colours.ground) };
}

const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", sans-serif';

/** A font of the page. */
export function font(size, weight = 400) {
  return `${weight} ${size}px ${FONT}`;
}

/** Text with a rim of the background, to be read over lines. */
export function rimmed(context, text, [x, y], colour, rim) {
  context.lineWidth = 4;
  context.strokeStyle = rim;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

/** The colour of a curve. */
export function colourOf({ look }, colours) {
  return colours.body(look + 1);
}

/** Its dashes. */
export function dashOf({ look }) {
  return DASHES[Math.floor(look / BODY_COLOURS) % DASHES.length];
}
