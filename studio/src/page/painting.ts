// Paints the whole drawing from the state of the page.
import { isPin } from "../catalogue/catalogue";
import { entry } from "../catalogue/tree";
import { found as camFound, cams, sizes } from "../design/cam";
import { paintCam } from "../design/camPainting";
import { before } from "../design/improve";
import { paintCandidate, paintPath, paintPoses } from "../design/painting";
import { stroke } from "../design/stroke";
import { active, candidate, poses as designPoses, draws, taken } from "../design/task";
import { paintCentres, paintCentrodes } from "../diagrams/painting";
import { centres, centrodes } from "../diagrams/shown";
import { paintArea } from "../draw/area";
import { paintArrows, type Vectors } from "../draw/arrows";
import { LENGTHS } from "../draw/display";
import { paintGhost } from "../draw/ghost";
import { paintGravity, paintGrid, paintLengthScale, paintNotes } from "../draw/measure";
import {
  paintHandles,
  paintLine,
  paintLinks,
  paintMark,
  paintPull,
  paintRing,
  paintSelectedBody,
} from "../draw/overlay";
import { paintItems } from "../draw/paint";
import { type Colours, palette } from "../draw/surface";
import { paintTraces } from "../draw/traces";
import { ghost } from "../guide/guide";
import { points } from "../modes/seen";
import { type Point, placed } from "../plane/points";
import { backdrop } from "../store/backdrop";
import { blamed, type Part } from "../store/blame";
import { preview, view, viewed } from "../store/sheet";
import { catalogue, items, mechanism, mode, poses, scene, selection, shown, tree, units } from "../store/state";
import { notes, outlines, type Shown, traces, vectors } from "./motionOverlay";

/** Read all signals that the drawing depends on, so that an effect follows them. */
export function follow(): void {
  for (const one of [
    backdrop,
    active,
    before,
    blamed,
    camFound,
    cams,
    candidate,
    centres,
    centrodes,
    ghost,
    viewed,
    preview,
    items,
    mechanism,
    mode,
    outlines,
    designPoses,
    draws,
    poses,
    scene,
    selection,
    shown,
    sizes,
    stroke,
    tree,
    traces,
    units,
    vectors,
  ])
    one.value;
}

/** Paint everything on a context in CSS pixels. */
export function paintSheet(context: CanvasRenderingContext2D, colours: Colours = palette(), bare = false): void {
  const found = mechanism.value;
  const editing = (mode.value === "edit" || mode.value === "design") && !bare;
  if (!bare) paintBackdrop(context);
  if (shown.value.grid) paintGrid(context, view, colours, editing);
  const replaced = mode.value === "design" && (cams.value || taken.value !== null);
  if (found && !replaced) {
    paintArea(context, view, outlines.value, colours);
    if (shown.value.traces) paintTraces(context, view, traces.value, colours);
    if (!bare) paintSelection(context, colours);
    if (!bare)
      for (const at of blamed.value.flatMap(placesOfPart)) paintRing(context, view, at, colours, 18, "problem");
    const names = paintItems(context, view, items.value, poses.value, shown.value, colours);
    paintBefore(context, colours);
    if (!items.value.length) paintLinks(context, view, found.bodies, poses.value, colours);
    if (editing && mode.value === "edit") paintHandles(context, view, loosePoints(), colours);
    names.push(...paintNotes(context, notes.value, colours));
    if (mode.value === "read" && centrodes.value) paintCentrodes(context, view, centrodes.value, poses.value, colours);
    if (mode.value === "read") paintCentres(context, view, centres.value, found.bodies.length, colours);
    paintArrows(context, view, vectors.value.map(sized), names, colours);
    paintGravity(context, view, found.gravity, colours);
  }
  if (mode.value === "design") paintDesign(context, colours);
  paintLengthScale(context, view, lengthScale(), colours);
  if (bare) return;
  if (ghost.value) paintGhost(context, view, ghost.value, colours);
  paintPreview(context, colours);
}

/** The mechanism before a search, faint. */
function paintBefore(context: CanvasRenderingContext2D, colours: Colours): void {
  if (!before.value) return;
  context.save();
  const { bodies, poses: places } = before.value;
  context.globalAlpha = 0.45;
  context.setLineDash([8, 6]);
  paintLinks(context, view, bodies, places, colours);
  context.setLineDash([]);
  const pairs = bodies.flatMap(({ points: of }, k) => Object.values(of).map((at) => placed(places[k]!, at)));
  paintHandles(context, view, pairs, colours);
  context.restore();
}

function paintDesign(context: CanvasRenderingContext2D, colours: Colours): void {
  if (cams.value) {
    if (camFound.value) paintCam(context, view, camFound.value, sizes.value, colours);
    return;
  }
  const [one, all] = [candidate.value, designPoses.value];
  if (one) paintCandidate(context, view, one, draws.value ? [] : all, active.value ?? 0, colours);
  if (draws.value) paintPath(context, view, all, active.value, stroke.value, colours);
  else paintPoses(context, view, all, active.value, colours);
}

/** The unit of the scale: mm if it is chosen; with m, the unit that suits the size of the mechanism. */
function lengthScale(): { unit: string; metres: number } {
  const { length } = units.value;
  const metre = { unit: length, metres: 1 / LENGTHS[length] };
  return length === "m" ? (scene.value?.length ?? metre) : metre;
}

/** Share of the drawing that the largest arrow of a kind takes. */
const LONGEST = 0.2;

function sized({ largest, ...vectors }: Shown): Vectors {
  const pixels = largest > 0 ? (LONGEST * Math.min(view.width, view.height)) / largest : 0;
  return { ...vectors, pixels };
}

function paintBackdrop(context: CanvasRenderingContext2D): void {
  const found = backdrop.value;
  if (!found) return;
  const { image, center, angle, opacity } = found;
  const [width, height] = [image.width, image.height].map((one) => one * found.scale * view.scale) as Point;
  context.save();
  context.globalAlpha = opacity;
  context.translate(...view.toScreen(center));
  context.rotate(-angle);
  context.drawImage(image, -width / 2, -height / 2, width, height);
  context.restore();
}

/** Points without a pin: a pin is drawn by its own symbol. */
function loosePoints(): Point[] {
  const pins = new Set(catalogue.value.joints.filter(isPin).map(({ name }) => name));
  const pinned = new Set<unknown>();
  for (const { name, type } of mechanism.value?.joints ?? []) {
    const joint = pins.has(type) ? entry(tree.value, "joints", name) : undefined;
    if (joint) for (const one of Object.values(joint)) pinned.add(one);
  }
  const all = points();
  return (items.value.length ? all.filter(({ body, point }) => !pinned.has(`${body.name}.${point}`)) : all).map(
    ({ at }) => at,
  );
}

function paintSelection(context: CanvasRenderingContext2D, colours: Colours): void {
  const chosen = selection.value;
  const bodies = mechanism.value?.bodies ?? [];
  if (!chosen) return;
  if (chosen.group === "bodies") {
    const k = bodies.findIndex(({ name }) => name === chosen.name);
    const [body, pose] = [bodies[k], poses.value[k]];
    if (!body || !pose) return;
    if (chosen.point && body.points[chosen.point])
      paintRing(context, view, placed(pose, body.points[chosen.point]!), colours);
    else if (!body.ground) paintSelectedBody(context, view, body, pose, colours);
    return;
  }
  for (const at of placesOf(Object.values(entry(tree.value, chosen.group, chosen.name) ?? {})))
    paintRing(context, view, at, colours, 15);
}

/** The places of a part that a fault names: its points, or those of a body. */
function placesOfPart({ group, name }: Part): Point[] {
  if (group === "bodies") return [];
  return placesOf(Object.values(entry(tree.value, group, name) ?? {})).slice(0, 1);
}

/** The positions of the points to which an element refers. */
function placesOf(references: unknown[]): Point[] {
  const found = points().filter(({ body, point }) => references.includes(`${body.name}.${point}`));
  return found.map(({ at }) => at);
}

function paintPreview(context: CanvasRenderingContext2D, colours: Colours): void {
  const shownNow = preview.value;
  if (!shownNow) return;
  paintLine(context, view, shownNow.line, shownNow.closed ?? false, shownNow.label ?? "", colours);
  if (shownNow.mark) paintMark(context, view, shownNow.mark.at, shownNow.mark.kind, colours);
  if (shownNow.pull) paintPull(context, view, ...shownNow.pull, colours);
}
