// Drawing with a tool of the palette: clicks choose places and references.

import type { Field } from "../catalogue/catalogue";
import { isPin } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { entry } from "../catalogue/tree";
import type { Body, Change, Value } from "../core/protocol";
import { displayed } from "../draw/display";
import { gridStep, snapStep } from "../draw/measure";
import { besideUnit, roundQuantity, significant } from "../draw/numbers";
import { type Added, addBody, type Case, GROUND, type Place, pointReference } from "../edit/adding";
import { addCurve, swap, takesCurves, takesPoints } from "../edit/commands";
import { addMachine, isMachine } from "../edit/composing";
import type { Motion } from "../edit/driving";
import { addElement, type Scale, wheelShare } from "../edit/element";
import { removed } from "../edit/removing";
import { hasLine, hasSides } from "../edit/swapping";
import { distance, type Point } from "../plane/points";
import { type Snapped, snapped } from "../plane/snap";
import { plainly } from "../store/blame";
import { change, undo } from "../store/document";
import { note } from "../store/note";
import { report } from "../store/session";
import { preview, typedLength, view } from "../store/sheet";
import {
  announce,
  catalogue,
  mechanism,
  panel,
  poses,
  problems,
  scene,
  selection,
  snapping,
  tool,
  tree,
  unassembled,
  units,
} from "../store/state";
import { texts } from "../texts";
import { alikeOf, coordinateOf } from "./coordinate";
import type { Handler, Spot } from "./handler";
import { lengthNow, readLength } from "./length";
import { curveUnder, isJoined, jointUnder, ownerUnder, pinBetween, pivotOf, type Under, under } from "./refer";
import { bodyUnder, links, points, targets } from "./seen";

let places: Place[] = [];
let chosen: Record<string, Value> = {};
let changes: Change[] = [];
let now: Motion[] = [];
/** The bodies under the clicked places that have no point there. */
let below: (Body | null)[] = [];

/** The work of earlier clicks; it resolves when all of it is done. */
let working: Promise<void> = Promise.resolve();

/** Run `what` after the work of earlier clicks, unless another tool is active by then. */
function queue(active: Tool, what: () => Promise<void>): Promise<void> {
  working = working.then(() => (tool.value === active ? what() : undefined)).catch(report);
  return working;
}

export const place: Handler = {
  down: () => true,
  up: (spot) => place.click!(spot),
  click(spot) {
    const active = tool.value;
    if (active) void queue(active, () => (active.placing ? clickPlace(active, spot) : clickReference(active, spot)));
  },
  double() {
    void finish();
    return true;
  },
  hover(spot) {
    const active = tool.value;
    if (!spot || !active) {
      preview.value = note.value = null;
      return;
    }
    last = spot.at;
    const { at, kind } = snapHere(spot);
    const line = places.length ? [...places.map((one) => one.at), at] : guideAt(active, spot, at);
    if (!refused || distance(refused, spot.px) > NEW) {
      refused = null;
      note.value = { at: spot.px, text: prompt(active) };
    }
    preview.value = {
      line,
      closed: active.placing === "many",
      mark: { at, kind },
      label: places.length ? labelOf(line) : "",
    };
  },
  cursor: () => "crosshair",
};

/** The last place of the pointer, in the plane. */
let last: Point | null = null;
/** The place of the pointer where the last click was refused; the reason stays until the pointer has moved. */
let refused: Point | null = null;
const NEW = 25;

/** What the next click chooses. */
function prompt(active: Tool): string {
  const { label, placing, references, type } = active;
  const k = references.findIndex(({ name }) => !(name in chosen));
  if (k >= 0) return texts.place.choose(label, type.name, k, references.length, String(references[k]!.shape));
  return places.length ? texts.place.next(label, placing) : texts.place.first(label, placing);
}

/** Say what the next click chooses, below the drawing and beside the pointer. */
function ask(active: Tool): void {
  const text = prompt(active);
  announce("info", text);
  if (note.value) note.value = { ...note.value, text };
}

/** The line that a click gives to the body under the pointer, for an element with a slot or a rack. */
function guideAt({ type }: Tool, spot: Spot, at: Point): Point[] {
  if (!type.fields.some(({ name }) => name === "axis" || name === "axes")) return [];
  const { body } = under(spot, new Set());
  const angle = body ? (poses.value[mechanism.value!.bodies.indexOf(body)]?.[2] ?? 0) : 0;
  const [x, y] = [GUIDE * Math.cos(angle), GUIDE * Math.sin(angle)].map((one) => one / view.scale) as Point;
  return [
    [at[0] - x, at[1] - y],
    [at[0] + x, at[1] + y],
  ];
}

/** Half of the drawn part of a slot, px. */
const GUIDE = 60;

function present(): Case {
  return { tree: tree.value, bodies: mechanism.value?.bodies ?? [], poses: poses.value };
}

function snapHere(spot: Spot): Snapped {
  return snapped(spot.at, {
    points: targets().map(({ at }) => at),
    lines: links(),
    step: snapStep(view),
    scale: view.scale,
    from: places.at(-1)?.at,
    length: lengthNow(),
    free: spot.free || !snapping.value,
  });
}

/** Length and direction of the last line. */
function labelOf(line: Point[]): string {
  const [a, b] = line.slice(-2);
  if (!a || !b) return "";
  const angle = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const [turn, length] = [displayed("rad", units.value), displayed("m", units.value)];
  const written = besideUnit(significant(angle * turn.factor, 3), turn.unit);
  return `${roundQuantity((distance(a, b) || 0) * length.factor, length.unit)}  ∠ ${written}`;
}

async function clickPlace(active: Tool, spot: Spot): Promise<void> {
  if (places.length && !(await readLength())) return;
  const { at } = snapHere(spot);
  const hits = targets().filter((hit) => distance(hit.at, at) * view.scale < 0.5);
  if (places.some((one) => distance(one.at, at) * view.scale < 2)) return;
  places.push({ at, hits });
  if (places.length > 1) typedLength.value = "";
  // a block may carry a point over the body that guides it
  const carries = active.placing === "slider" || !hits.length;
  below.push(carries ? bodyUnder(spot, new Set(hits.map(({ body }) => body.name))) : null);
  const enough = active.placing === "many" ? 8 : active.placing === "one" || active.placing === "fixed" ? 1 : 2;
  if (places.length >= enough) await make(active);
  else ask(active);
}

/** Make the body from the places that are chosen. After a typed length, the next place is toward the pointer. */
export async function finish(): Promise<void> {
  const active = tool.value;
  const from = places.at(-1);
  if (active?.placing && from && typedLength.value.trim()) {
    const [x, y] = last ?? [from.at[0] + 1, from.at[1]];
    const toward: Point = x === from.at[0] && y === from.at[1] ? [x + 1, y] : [x, y];
    await queue(active, () => clickPlace(active, { px: view.toScreen(toward), at: toward, touch: false, free: false }));
  } else if (active) await queue(active, () => make(active));
}

async function make(active: Tool): Promise<void> {
  const least = active.placing === "one" || active.placing === "fixed" ? 1 : 2;
  if (!active.placing || places.length < least) return;
  const [made, bodies] = [places, below];
  restart();
  const added = isMachine(active)
    ? addMachine(active, [made[0]!, made[1]!], bodies, catalogue.value, present())
    : addBody(active, made, catalogue.value, present());
  await apply(active, added);
}

async function clickReference(active: Tool, spot: Spot): Promise<void> {
  const field = active.references.find(({ name }) => !(name in chosen));
  if (field) {
    const [kept, added] = [places.length, changes.length];
    const reference = await referenceOf(active, field, spot);
    const wrong = reference === null ? "" : wrongSide(active, field, reference);
    if (wrong) {
      places.length = kept;
      changes.length = added;
      return tell(spot, wrong);
    }
    if (reference === null) return refuse(active, field, spot);
    chosen[field.name] = reference;
  }
  await goOn(active);
}

/** Why a reference cannot be chosen, because of its body; empty if it can. */
function wrongSide({ references, type }: Tool, field: Field, reference: string): string {
  const shape = String(field.shape);
  if (!["point", "body", "curve"].includes(shape)) return "";
  const body = reference.split(".")[0]!;
  const wanted = texts.place.role(type.name, references.indexOf(field), references.length, shape);
  if (Object.values(chosen).some((one) => String(one).split(".")[0] === body)) return texts.place.same(body, wanted);
  return references.length === 1 && body === GROUND ? texts.place.notGround(wanted) : "";
}

/** Give the reason of a refused click, below the drawing and beside the pointer. */
function tell(spot: Spot, text: string, more: Parameters<typeof announce>[2] = {}): void {
  announce("info", text, more);
  refused = spot.px;
  note.value = { at: spot.px, text, kind: "wrong" };
}

/** Show which reference is needed. If it is a curve, offer to add one. */
function refuse(active: Tool, field: Field, spot: Spot): void {
  const { references, type } = active;
  const found = under(spot, taken(), field.shape === "curve");
  const held = active.group === "drivers" && field.shape === "coordinate" ? ownerUnder(found) : null;
  const wanted = held
    ? texts.place.held(held)
    : texts.place.wanted(String(field.shape), type.name, references.indexOf(field), references.length);
  const body = found.body?.name ?? GROUND;
  const add = async () => {
    const curve = await addCurve(body, snapHere(spot).at);
    if (curve === null) return;
    chosen[field.name] = `${body}.${curve}`;
    await goOn(active);
  };
  const action = { label: texts.place.addCurve(body), run: () => void queue(active, add) };
  tell(spot, wanted, field.shape === "curve" && takesCurves(body) ? { action } : {});
}

/** Show which reference is next, or make the element. */
async function goOn(active: Tool): Promise<void> {
  const next = active.references.find(({ name }) => !(name in chosen));
  if (next) ask(active);
  else await complete(active);
}

async function complete(active: Tool): Promise<void> {
  const added = addElement(active, chosen, scaleNow(active), tree.value);
  const pin = takesPin(active) && pinBetween(chosen.i, chosen.j);
  const gone = pin ? removed(tree.value, "joints", pin) : [];
  const all = { ...added, changes: [...gone, ...changes, ...added.changes] };
  restart(active.references.length ? active : null);
  await apply(active, all, pin || undefined);
}

/** Whether a joint takes the place of a pin: it adds to its equations or weakens them. */
function takesPin({ group, type }: Tool): boolean {
  return group === "joints" && type.fields.some(({ name }) => ["angle", "axis", "clearance"].includes(name));
}

/** The measures of the drawing for initial values. */
function scaleNow({ type }: Tool): Scale {
  const { bodies = [], gravity = [0, 0] } = mechanism.value ?? {};
  const poseOf = (reference: Value | undefined) =>
    poses.value[bodies.findIndex(({ name }) => name === String(reference).split(".")[0])] ?? [0, 0, 0];
  const [[, , first], [, , second]] = [poseOf(chosen.i), poseOf(chosen.j)];
  const [a, b] = places.map(({ at }) => at);
  const mass = bodies.reduce((sum, body) => sum + (body.mass ?? 0), 0) || 1;
  const [x0, y0, x1, y1] = scene.value?.bounds ?? [0, 0, 0, 0];
  const line = type.fields.some(({ name }) => name === "axis");
  const joint = String(entry(tree.value, "joints", String(chosen.joint))?.type);
  return {
    length: a && b ? distance(a, b) : gridStep(view) / 2,
    size: Math.max(x1 - x0, y1 - y0) || gridStep(view),
    mass,
    weight: mass * (Math.hypot(...gravity) || 9.81),
    turn: second - first,
    offset: a && b ? offsetOf(type, a, b, first, second) : 0,
    beside: a && b && line ? Math.cos(first) * (b[1] - a[1]) - Math.sin(first) * (b[0] - a[0]) : 0,
    pin: catalogue.value.joints.some((one) => one.name === joint && isPin(one)),
    degrees: units.value.degrees,
    now,
  };
}

async function apply(active: Tool, { changes: all, name }: Added, pin?: string): Promise<void> {
  if (!(await change(all))) return;
  selection.value = { group: active.group, name };
  if (active.placing !== "fixed" && panel.value !== "text") panel.value = "properties";
  const problem = problems.value[0] ?? unassembled.value;
  const back = { label: texts.status.undo, run: () => void undo() };
  if (problem)
    announce("problem", texts.place.incomplete(active.label, name, plainly(problem.message)), { action: back });
  else
    announce(
      "done",
      texts.place.added(active.label, name, pin),
      hasSides(active.type) && hasLine(active.type) ? { action: swapAction(name) } : {},
    );
}

/** The sum of the arcs of two wheels from the line of their centres; those of a belt are subtracted. */
function offsetOf({ fields }: Tool["type"], a: Point, b: Point, first: number, second: number): number {
  const radii = fields.find(({ name }) => name === "radii");
  if (!radii || !fields.some(({ name }) => name === "offset")) return 0;
  const line = Math.atan2(b[1] - a[1], b[0] - a[0]);
  const belt = fields.some(({ name }) => name === "crossed");
  const turns = belt ? first - second : first + second - 2 * line;
  // whole turns do not matter for gears
  const least = belt ? turns : turns - 4 * Math.PI * Math.round(turns / (4 * Math.PI));
  return Math.abs(least) > 1e-9 ? least * distance(a, b) * wheelShare(radii.required) : 0;
}

function swapAction(name: string) {
  return { label: texts.place.swap, run: () => void swap("joints", name) };
}

/** The bodies of the references that are chosen. */
function taken(): Set<string> {
  return new Set(Object.values(chosen).map((one) => String(one).split(".")[0]!));
}

/** The reference under the pointer, in the notation of the file. */
async function referenceOf(active: Tool, field: Field, spot: Spot): Promise<string | null> {
  const shape = String(field.shape);
  const wheel = field.doc.startsWith("Centre");
  const found = under(spot, taken(), wheel || shape === "curve" || active.references.length === 1);
  const pivot = wheel && found.body && !isJoined(found.fresh) ? pivotOf(found.body) : null;
  if (pivot) {
    const hit = points().find(({ body, point }) => body === found.body && point === pivot)!;
    return pointUnder(spot, { ...found, fresh: hit });
  }
  if (shape === "body") return found.body?.name ?? GROUND;
  if (shape === "point") return found.fresh || takesPoints(found.body?.name ?? GROUND) ? pointUnder(spot, found) : null;
  if (shape === "joint") return jointUnder(found);
  if (shape === "curve") return curveUnder(found);
  const owner = ownerUnder(found);
  const motion = now.length ? await alikeOf(owner, now) : await coordinateOf(owner, active.group !== "drivers");
  if (motion) now.push(motion);
  return motion?.name ?? null;
}

/** The point under the pointer, or a new point of the body there. */
function pointUnder(spot: Spot, { fresh, body }: Under): string {
  const { at } = snapHere(spot);
  places.push({ at: fresh?.at ?? at, hits: [] });
  const names = changes.map(({ path }) => String(path.at(-1)));
  const found = pointReference({ at, hits: fresh ? [fresh] : [] }, body, present(), names);
  changes.push(...found.changes);
  return found.reference;
}

/** Forget all clicks, and start with the active tool or another one. */
export function restart(next: Tool | null = tool.value): void {
  [places, below, chosen, changes, now] = [[], [], {}, [], []];
  typedLength.value = "";
  preview.value = note.value = refused = null;
  tool.value = next;
  if (!next) return;
  ask(next);
  if (!next.placing && !next.references.length) void complete(next);
}

/** Whether a line is in progress; its length may then be typed. */
export function drawing(): boolean {
  return places.length > 0 && tool.value?.placing !== null;
}

/** Add the first driver of the catalogue to a coordinate. */
export async function driveBy(all: readonly Tool[], motion: Motion): Promise<void> {
  const active = all.find(({ group, references }) => group === "drivers" && references[0]?.shape === "coordinate");
  if (!active) return;
  restart(null);
  [chosen, now] = [{ [active.references[0]!.name]: motion.name }, [motion]];
  const added = addElement(active, chosen, scaleNow(active), tree.value);
  restart(null);
  await apply(active, added);
}
