// Saves the motion of a run as a GIF. Each frame is a step of the event loop, so that the page stays responsive.
import { signal } from "@preact/signals";
import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { type Colours, paperPalette } from "../draw/surface";
import { course, pause, rate, show, span, time } from "../modes/read";
import { paintSheet } from "../page/painting";
import { report } from "../store/session";
import { view } from "../store/sheet";
import { title } from "../store/state";
import { download, nameOf } from "./download";

/** The shortest time of a frame, s; players show shorter ones too slowly. */
const SHORTEST = 0.04;
/** The largest number of frames. A longer motion has longer frames. */
const MOST_FRAMES = 250;
/** The larger side of the picture, px. */
const MOST_PIXELS = 640;
const COLOURS = 256;

/** The finished share; null if no GIF is in progress. */
export const making = signal<number | null>(null);

export function cancelGif(): void {
  making.value = null;
}

/** The times of the frames for a speed, and the duration of each frame, in hundredths of a second. */
export function framesOf([begin, end]: readonly [number, number], speed: number): { times: number[]; delay: number } {
  const seconds = (end - begin) / speed;
  const delay = Math.max(SHORTEST * 100, Math.ceil((100 * seconds) / MOST_FRAMES));
  const count = Math.max(1, Math.round((100 * seconds) / delay));
  return { times: Array.from({ length: count }, (_, k) => begin + (k * (end - begin)) / count), delay };
}

/** Save the motion as a repeating GIF, with the speed and the view of the page. */
export async function saveGif(): Promise<void> {
  const found = course.value;
  if (!found || making.value !== null) return;
  pause();
  const before = time.value;
  making.value = 0;
  try {
    const bytes = await encoded(() => course.value === found && making.value !== null);
    if (bytes) download(nameOf(title.value, ".gif"), bytes, "image/gif");
  } catch (error) {
    report(error);
  }
  making.value = null;
  if (course.value === found) show(before);
}

/** The file, or null if it was cancelled. */
async function encoded(goesOn: () => boolean): Promise<Uint8Array<ArrayBuffer> | null> {
  const { times, delay } = framesOf(span.value, rate.value);
  const picture = new Picture();
  const overview = picture.overview(times);
  await new Promise((done) => setTimeout(done));
  const palette = quantize(overview, COLOURS);
  const gif = GIFEncoder();
  for (const [k, at] of times.entries()) {
    await new Promise((done) => setTimeout(done));
    if (!goesOn()) return null;
    making.value = k / times.length;
    show(at);
    const pixels = applyPalette(picture.painted(), palette);
    await new Promise((done) => setTimeout(done));
    const first = k === 0 ? { palette, repeat: 0 } : {};
    gif.writeFrame(pixels, picture.width, picture.height, { ...first, delay: 10 * delay });
  }
  gif.finish();
  return new Uint8Array(gif.bytes());
}

/** Paints the sheet on white paper, with the view at the start. */
class Picture {
  private readonly framed = { center: view.center, scale: view.scale, width: view.width, height: view.height };
  private readonly ratio = Math.min(1, MOST_PIXELS / Math.max(view.width, view.height));
  readonly width = Math.round(view.width * this.ratio);
  readonly height = Math.round(view.height * this.ratio);
  private readonly context: CanvasRenderingContext2D;
  private readonly colours: Colours = paperPalette();

  constructor() {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [this.width, this.height];
    this.context = canvas.getContext("2d", { willReadFrequently: true })!;
    this.context.lineCap = "round";
    this.context.lineJoin = "round";
  }

  painted(): Uint8ClampedArray {
    this.clear();
    this.paint(this.ratio, 0, 0);
    return this.context.getImageData(0, 0, this.width, this.height).data;
  }

  /** Four small pictures at different times, side by side. The colours of all frames are chosen from them. */
  overview(times: readonly number[]): Uint8ClampedArray {
    this.clear();
    for (const k of [0, 1, 2, 3]) {
      show(times[Math.floor((k * (times.length - 1)) / 3)]!);
      this.paint(this.ratio / 4, (k % 2) * 0.25 * this.width, k > 1 ? 0.25 * this.height : 0);
    }
    return this.context.getImageData(0, 0, Math.ceil(this.width / 2), Math.ceil(this.height / 2)).data;
  }

  private clear(): void {
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.fillStyle = this.colours.named.panel!;
    this.context.fillRect(0, 0, this.width, this.height);
  }

  private paint(scale: number, x: number, y: number): void {
    const { center, scale: pixels, width, height } = view;
    Object.assign(view, this.framed);
    this.context.setTransform(scale, 0, 0, scale, x, y);
    paintSheet(this.context, this.colours, true);
    Object.assign(view, { center, scale: pixels, width, height });
  }
}
