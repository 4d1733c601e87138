// Small pictures of the examples, which move while the pointer or the focus is on them. A second core computes them, so
// that the mechanism on the sheet is left alone.
import type { Triple } from "../core/protocol";
import type { Transport } from "../core/transport";
import type { Item } from "../draw/items";
import { Loop } from "../draw/loop";
import { paintItems } from "../draw/paint";
import { cleared, palette, sharpen } from "../draw/surface";
import { type Course, inOrder, posesAt } from "../modes/read";
import { type Placement, type Point, placed } from "../plane/points";
import { type Bounds, View } from "../plane/view";
import { another } from "../store/session";
import { still } from "../store/still";

/** The size for which a picture is laid out, px; it is painted smaller. */
const [WIDTH, HEIGHT] = [420, 280];
/** Room around a picture, as a share of its size. */
const ROOM = 0.04;
/** A motion is played in its own time within these limits, s. */
const PLAYED = [2.5, 8] as const;
const SILENT = { names: false, numbers: false };

interface Picture {
  items: Item[];
  start: Placement[];
  bounds: Bounds;
  points: Point[][];
  analyses: string[];
}

interface Motion extends Pick<Course, "t" | "rows" | "width"> {
  view: View;
}

/** A core and what waits for it: it has one text at a time. */
interface Work {
  core: Transport;
  stills: (() => Promise<void>)[];
  motions: (() => Promise<void>)[];
  busy: boolean;
}

let work: Work | null = null;

/** Do something with the core: pictures come before motions. */
function next<T>(kind: "stills" | "motions", act: (core: Transport) => Promise<T>): Promise<T> {
  work ??= { core: another(), stills: [], motions: [], busy: false };
  const found = work;
  return new Promise((resolve, reject) => {
    found[kind].push(() => act(found.core).then(resolve, reject));
    if (!found.busy) void goOn(found);
  });
}

async function goOn(found: Work): Promise<void> {
  found.busy = true;
  const taken = () => found.stills.shift() ?? found.motions.shift();
  for (let act = taken(); act; act = taken()) await act();
  found.busy = false;
}

/** End the core of the pictures. */
export function endPictures(): void {
  work?.core.end();
  work = null;
}

async function drawn(core: Transport, text: string): Promise<Picture> {
  const { mechanism, pose } = (await core.send("load", { text })).ok;
  if (!mechanism || !pose) throw new Error();
  const { scene } = (await core.send("scene", {})).ok;
  const { items } = (await core.send("display", { width: WIDTH, height: HEIGHT, ...SILENT })).ok;
  return {
    items,
    start: [[0, 0, 0], ...pose.poses],
    bounds: scene.bounds,
    points: mechanism.bodies.map(({ points }) => Object.values(points)),
    analyses: mechanism.analyses.map(({ name }) => name),
  };
}

/** The first analysis that is a motion, in a view that contains the ways of all points. */
async function moved(core: Transport, text: string, { analyses, points, bounds }: Picture): Promise<Motion | null> {
  await core.send("load", { text });
  for (const analysis of analyses) {
    const { ok } = await core.send("run", { analysis });
    if (!("count" in ok)) continue;
    const { numbers } = await core.send("frames", {});
    const course = { width: 3 * points.length - 2, ...inOrder(numbers, 3 * points.length - 2) };
    return { ...course, view: viewOf(around(course, points, bounds)) };
  }
  return null;
}

function around({ rows, width }: Pick<Course, "rows" | "width">, points: Point[][], bounds: Bounds): Bounds {
  let [x0, y0, x1, y1] = bounds;
  for (let row = 0; row < rows.length; row += width)
    points.forEach((own, body) => {
      const at = row + 3 * body - 2;
      if (body)
        for (const point of own) {
          const [x, y] = placed(Array.from(rows.subarray(at, at + 3)) as Triple, point);
          [x0, y0, x1, y1] = [Math.min(x0, x), Math.min(y0, y), Math.max(x1, x), Math.max(y1, y)];
        }
    });
  return [x0, y0, x1, y1];
}

function viewOf([x0, y0, x1, y1]: Bounds): View {
  const room = ROOM * Math.max(x1 - x0, y1 - y0);
  const view = new View([x0 - room, y0 - room, x1 + room, y1 + room]);
  view.resize(WIDTH, HEIGHT);
  return view;
}

/** The picture of one example on a canvas. */
export class Thumb {
  private picture: Promise<Picture> | null = null;
  private motion: Promise<Motion | null> | null = null;
  private wanted = false;
  private readonly loop = new Loop({ value: false });

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly text: string,
  ) {}

  /** Draw the start; without a picture, the place stays empty. */
  async show(): Promise<void> {
    this.picture ??= next("stills", (core) => drawn(core, this.text));
    const found = await this.picture;
    if (!this.wanted) this.paint(found, viewOf(found.bounds), found.start);
  }

  /** Play the motion again and again until `stop`, unless the system requests reduced motion. */
  async play(): Promise<void> {
    if (still()) return;
    this.wanted = true;
    await this.show();
    const picture = await this.picture!;
    // a motion that nobody waits for any more is not computed
    this.motion ??= next("motions", async (core) => (this.wanted ? moved(core, this.text, picture) : null));
    const found = await this.motion;
    if (!found) this.motion = null;
    if (!found || !this.wanted) return;
    const [begin, end] = [found.t[0]!, found.t.at(-1)!];
    const seconds = Math.min(PLAYED[1], Math.max(PLAYED[0], end - begin));
    let share = 0;
    await this.loop.play((ms) => {
      share = (share + ms / 1000 / seconds) % 1;
      this.paint(picture, found.view, [[0, 0, 0], ...posesAt(found, begin + share * (end - begin))]);
      return this.wanted;
    });
  }

  stop(): void {
    if (!this.wanted) return;
    this.wanted = false;
    this.loop.stop();
    void this.show().catch(() => {});
  }

  private paint(picture: Picture, view: View, poses: Placement[]): void {
    sharpen(this.canvas);
    const context = cleared(this.canvas);
    const { width, height } = this.canvas.getBoundingClientRect();
    const scale = Math.min(width / WIDTH, height / HEIGHT);
    context.translate((width - scale * WIDTH) / 2, (height - scale * HEIGHT) / 2);
    context.scale(scale, scale);
    paintItems(context, view, picture.items, poses, SILENT, palette());
  }
}
