// The drawing of the scene at one instant, and the visible part of the plane.
import { ARROW_KINDS, type Arrow, paintArrows } from "../draw/arrows";
import { paintGravity, paintGrid, paintLengthScale, paintNotes } from "../draw/measure";
import { paintItems } from "../draw/paint";
import { type Colours, cleared, sharpen } from "../draw/surface";
import { paintTraces, Trace } from "../draw/traces";
import { type Point, placed } from "../plane/points";
import { extent, View } from "../plane/view";
import type { Instant, Motion } from "./motion";
import type { Scene } from "./scene";
import { SceneVectors } from "./vectors";

/** Draws the scene on a canvas. */
export class Drawing {
  readonly view: View;
  readonly shown = {
    names: true,
    numbers: true,
    paths: true,
    reactions: false,
    force: false,
    velocities: false,
    accelerations: false,
  };
  magnification = 1;
  /** The number of the body whose arrows are shown; null for those of all bodies. */
  onBody: number | null = null;
  /** The arrows that were painted last. */
  arrows: Arrow[] = [];
  private readonly vectors: SceneVectors;
  private readonly traces: Trace[];

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly scene: Scene,
    private readonly motion: Motion,
  ) {
    this.view = new View(scene.bounds);
    this.vectors = new SceneVectors(scene);
    const piece = extent(scene.bounds) / 200;
    this.traces = scene.traces.map(({ body, point }) => new Trace(body, motion.path(body, point, piece)));
    this.resize();
  }

  /** Take up the size that the canvas has on the page. */
  resize(): void {
    sharpen(this.canvas);
    const { width, height } = this.canvas.getBoundingClientRect();
    this.view.resize(width, height);
  }

  /** The positions of the joints on the canvas at one instant, CSS pixels: their points on body j. */
  pins(now: Instant): { name: string; at: Point }[] {
    return this.scene.joints.map(({ name, bodies: [, j], points: [, at] }) => {
      return { name, at: this.view.toScreen(placed(now.poses[j]!, at)) };
    });
  }

  /** Draw the instant t, on the canvas of the page or another one. */
  paint(t: number, colours: Colours, context = cleared(this.canvas)): void {
    const { scene, view, shown, vectors } = this;
    const now = this.motion.at(t);
    paintGrid(context, view, colours, false);
    if (shown.paths) paintTraces(context, view, this.traces, colours);
    const names = paintItems(context, view, scene.display, now.poses, shown, colours);
    const chosen = ARROW_KINDS.filter((kind) => shown[kind]);
    names.push(...paintNotes(context, vectors.notes(chosen), colours));
    const kinds = chosen.map((kind) => ({
      kind,
      unit: vectors.unit(kind),
      pixels: this.magnification * view.fitted() * vectors.length(kind),
      vectors: vectors.of(kind, now, this.onBody),
    }));
    this.arrows = paintArrows(context, view, kinds, names, colours);
    paintLengthScale(context, view, scene.length, colours);
    paintGravity(context, view, scene.gravity, colours);
  }
}
