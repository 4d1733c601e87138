// Drawing with a tool of the palette: clicks choose places and references.

import type { Field } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import type { Change, Value } from "../core/protocol";
import { displayed } from "../draw/display";
import { gridStep, snapStep } from "../draw/measure";
import { besideUnit, roundQuantity, significant } from "../draw/numbers";
import { type Added, addBody, type Case, GROUND, type Place, pointReference } from "../edit/adding";
import { addCurve, takesCurves } from "../edit/commands";
import type { Motion } from "../edit/driving";
import { addElement } from "../edit/element";
import { distance, type Point } from "../plane/points";
import { type Snapped, snapped } from "../plane/snap";
import { change } from "../store/document";
import { report } from "../store/session";
import { preview, typedLength, view } from "../store/sheet";
import {
  announce,
  catalogue,
  mechanism,
  panel,
  poses,
  problems,
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
import { curveUnder, jointUnder, ownerUnder, type Under, under } from "./refer";
import { points } from "./seen";

let places: Place[] = [];
let chosen: Record<string, Value> = {};
let changes: Change[] = [];
let now: Motion[] = [];

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
      preview.value = null;
      return;
    }
    const { at, kind } = snapHere(spot);
    const line = [...places.map((one) => one.at), at];
    preview.value = {
      line: places.length ? line : [],
      closed: active.placing === "many",
      mark: { at, kind },
      label: labelOf(line),
    };
  },
  cursor: () => "crosshair",
};

function present(): Case {
  return { tree: tree.value, bodies: mechanism.value?.bodies ?? [], poses: poses.value };
}

function snapHere(spot: Spot): Snapped {
  return snapped(spot.at, {
    points: points().map(({ at }) => at),
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
  const hits = points().filter((hit) => distance(hit.at, at) * view.scale < 0.5);
  if (places.some((one) => distance(one.at, at) * view.scale < 2)) return;
  places.push({ at, hits });
  if (places.length > 1) typedLength.value = "";
  const enough = active.placing === "many" ? 8 : active.placing === "two" ? 2 : 1;
  if (places.length >= enough) await make(active);
  else announce("info", texts.place.next(active.label, active.placing === "many"));
}

/** Make the body from the places that are chosen. */
export async function finish(): Promise<void> {
  const active = tool.value;
  if (active) await queue(active, () => make(active));
}

async function make(active: Tool): Promise<void> {
  if (!active.placing || places.length < (active.placing === "two" || active.placing === "many" ? 2 : 1)) return;
  const made = places;
  restart();
  await apply(active, addBody(active, made, catalogue.value, present()));
}

async function clickReference(active: Tool, spot: Spot): Promise<void> {
  const field = active.references.find(({ name }) => !(name in chosen));
  if (field) {
    const reference = await referenceOf(active, String(field.shape), spot);
    if (reference === null) return refuse(active, field, spot);
    chosen[field.name] = reference;
  }
  await goOn(active);
}

/** Show which reference is needed. If it is a curve, offer to add one. */
function refuse(active: Tool, field: Field, spot: Spot): void {
  const found = under(spot, new Set());
  const held = active.group === "drivers" && field.shape === "coordinate" ? ownerUnder(found) : null;
  const wanted = held ? texts.place.held(held) : texts.place.wanted(String(field.shape));
  const body = found.body?.name ?? GROUND;
  const add = async () => {
    const curve = await addCurve(body);
    if (curve === null) return;
    chosen[field.name] = `${body}.${curve}`;
    await goOn(active);
  };
  const action = { label: texts.place.addCurve(body), run: () => void queue(active, add) };
  announce("info", wanted, field.shape === "curve" && takesCurves(body) ? { action } : {});
}

/** Show which reference is next, or make the element. */
async function goOn(active: Tool): Promise<void> {
  const next = active.references.find(({ name }) => !(name in chosen));
  if (next) announce("info", texts.place.choose(active.label, next.name, String(next.shape)));
  else await complete(active);
}

async function complete(active: Tool): Promise<void> {
  const length = places.length > 1 ? distance(places[0]!.at, places[1]!.at) : gridStep(view) / 2;
  const added = addElement(active, chosen, { length, degrees: units.value.degrees, now }, tree.value);
  const all = { ...added, changes: [...changes, ...added.changes] };
  restart(active.references.length ? active : null);
  await apply(active, all);
}

async function apply(active: Tool, { changes: all, name }: Added): Promise<void> {
  if (!(await change(all))) return;
  selection.value = { group: active.group, name };
  if (active.placing !== "fixed" && panel.value !== "text") panel.value = "properties";
  const problem = problems.value[0] ?? unassembled.value;
  if (problem) announce("problem", texts.place.incomplete(active.label, name, problem.message));
  else announce("done", texts.place.added(active.label, name));
}

/** The reference under the pointer, in the notation of the file. */
async function referenceOf(active: Tool, shape: string, spot: Spot): Promise<string | null> {
  const taken = new Set(Object.values(chosen).map((one) => String(one).split(".")[0]!));
  const found = under(spot, taken);
  if (shape === "body") return found.body?.name ?? GROUND;
  if (shape === "point") return pointUnder(spot, found);
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
  [places, chosen, changes, now] = [[], {}, [], []];
  typedLength.value = "";
  preview.value = null;
  tool.value = next;
  if (!next) return;
  const first = next.references[0];
  announce(
    "info",
    first
      ? texts.place.choose(next.label, first.name, String(first.shape))
      : texts.place.first(next.label, next.placing),
  );
  if (!next.placing && !first) void complete(next);
}

/** Whether a line is in progress; its length may then be typed. */
export function drawing(): boolean {
  return places.length > 0 && tool.value?.placing !== null;
}
