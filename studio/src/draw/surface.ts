// A canvas that is as sharp as the screen, and the colours of the page.
import type { Point } from "../plane/points";

const NAMES = [
  "page",
  "panel",
  "edge",
  "text",
  "soft",
  "accent",
  "grid",
  "ground",
  "paper",
  "ink",
  "force",
  "drive",
  "quiet",
  "reactions",
  "velocities",
  "accelerations",
  "problem",
] as const;

export type ColourName = (typeof NAMES)[number];

export interface Colours {
  named: Record<ColourName, string>;
  body(number: number): string;
}

const BODY_COLOURS = 7;
/** Strokes and gaps, px, of curves beyond the number of colours. */
const DASHES = [[], [7, 4], [2, 4], [9, 3, 2, 3]];

/** Fit a canvas to its place. */
export function sharpen(canvas: HTMLCanvasElement): void {
  const { width, height } = canvas.getBoundingClientRect();
  const ratio = window.devicePixelRatio || 1;
  const [w, h] = [Math.max(1, Math.round(width * ratio)), Math.max(1, Math.round(height * ratio))];
  if (canvas.width === w && canvas.height === h) return;
  canvas.width = w;
  canvas.height = h;
}

/** A cleared drawing context in CSS pixels. */
export function cleared(canvas: HTMLCanvasElement): CanvasRenderingContext2D {
  const context = canvas.getContext("2d")!;
  const { width, height } = canvas.getBoundingClientRect();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.setTransform(canvas.width / Math.max(1, width), 0, 0, canvas.height / Math.max(1, height), 0, 0);
  context.lineCap = "round";
  context.lineJoin = "round";
  return context;
}

/** The present colours of the page, light or dark. */
export function palette(): Colours {
  const style = getComputedStyle(document.documentElement);
  const read = (name: string) => style.getPropertyValue(`--${name}`).trim();
  const named = Object.fromEntries(NAMES.map((name) => [name, read(name)])) as Colours["named"];
  const bodies = Array.from({ length: BODY_COLOURS }, (_, k) => read(`body-${k + 1}`));
  return { named, body: (number) => (number ? bodies[(number - 1) % BODY_COLOURS]! : named.ground) };
}

/** The colours of a picture on white paper, also if the page is dark. */
export function paperPalette(): Colours {
  document.documentElement.classList.add("paper");
  const found = palette();
  document.documentElement.classList.remove("paper");
  return found;
}

const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Liberation Sans", sans-serif';

/** A font of the page. */
export function font(size: number, weight = 400): string {
  return `${weight} ${size}px ${FONT}`;
}

/** Text with a rim of the background, to be read over lines. */
export function rimmed(
  context: CanvasRenderingContext2D,
  text: string,
  [x, y]: Point,
  colour: string,
  rim: string,
): void {
  context.lineWidth = 4;
  context.strokeStyle = rim;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

/** The colour of the curve with this number. */
export function colourOf(number: number, colours: Colours): string {
  return colours.body((number % BODY_COLOURS) + 1);
}

/** The dashes of the curve with this number. */
export function dashOf(number: number): number[] {
  return DASHES[Math.floor(number / BODY_COLOURS) % DASHES.length]!;
}
