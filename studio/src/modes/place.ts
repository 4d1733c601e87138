// Drawing with a tool of the palette: clicks choose places and references.

import type { Tool } from "../catalogue/tools";
import { entry, isTable } from "../catalogue/tree";
import type { Change, Value } from "../core/protocol";
import { displayed, LENGTHS } from "../draw/display";
import { gridStep, snapStep } from "../draw/measure";
import { besideUnit, roundQuantity, significant } from "../draw/numbers";
import { type Added, addBody, addElement, type Case, type Place, pointReference } from "../edit/adding";
import { distance, type Point } from "../plane/points";
import { type Snapped, snapped } from "../plane/snap";
import { change } from "../store/document";
import { send } from "../store/session";
import { preview, typedLength, view } from "../store/sheet";
import { announce, catalogue, mechanism, panel, poses, selection, snapping, tool, tree, units } from "../store/state";
import { texts } from "../texts";
import type { Handler, Spot } from "./handler";
import { bodyUnder, elementUnder, points, pointsUnder } from "./seen";

let places: Place[] = [];
let chosen: Record<string, Value> = {};
let changes: Change[] = [];
let now: number | null = null;

export const place: Handler = {
  down: () => true,
  up: (spot) => place.click!(spot),
  click(spot) {
    const active = tool.value;
    if (active?.placing) void clickPlace(active, spot);
    else if (active) void clickReference(active, spot);
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
  const typed = Number(typedLength.value) / LENGTHS[units.value.length];
  return snapped(spot.at, {
    points: points().map(({ at }) => at),
    step: snapStep(view),
    scale: view.scale,
    from: places.at(-1)?.at,
    length: typedLength.value && typed > 0 ? typed : undefined,
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
  const { at } = snapHere(spot);
  const hits = points().filter((hit) => distance(hit.at, at) * view.scale < 0.5);
  if (places.some((one) => distance(one.at, at) * view.scale < 2)) return;
  places.push({ at, hits });
  typedLength.value = "";
  const enough = active.placing === "many" ? 8 : active.placing === "two" ? 2 : 1;
  if (places.length >= enough) await finish();
  else announce("info", texts.place.next(active.label, active.placing === "many"));
}

/** Make the body of the places chosen so far. */
export async function finish(): Promise<void> {
  const active = tool.value;
  if (!active?.placing || places.length < (active.placing === "two" || active.placing === "many" ? 2 : 1)) return;
  const made = places;
  restart();
  await apply(active, addBody(active, made, catalogue.value, present()));
}

async function clickReference(active: Tool, spot: Spot): Promise<void> {
  const field = active.references.find(({ name }) => !(name in chosen));
  if (field) {
    const reference = await referenceOf(String(field.shape), spot);
    if (reference === null) {
      announce("info", texts.place.wanted(String(field.shape)));
      return;
    }
    chosen[field.name] = reference;
  }
  const next = active.references.find(({ name }) => !(name in chosen));
  if (next) announce("info", texts.place.choose(active.label, next.name, String(next.shape)));
  else await complete(active);
}

async function complete(active: Tool): Promise<void> {
  const length = places.length > 1 ? distance(places[0]!.at, places[1]!.at) : gridStep(view) / 2;
  const added = addElement(active, chosen, { length, now }, tree.value);
  const all = { ...added, changes: [...changes, ...added.changes] };
  restart();
  await apply(active, all);
}

async function apply(active: Tool, { changes: all, name }: Added): Promise<void> {
  if (!(await change(all))) return;
  selection.value = { group: active.group, name };
  if (active.placing !== "fixed" && panel.value !== "text") panel.value = "properties";
  announce("done", texts.place.added(active.label, name));
}

/** What the pointer refers to, as a text of the file. */
async function referenceOf(shape: string, spot: Spot): Promise<string | null> {
  const hits = pointsUnder(spot);
  const taken = new Set(Object.values(chosen).map((one) => String(one).split(".")[0]));
  const fresh = hits.find(({ body }) => !taken.has(body.name)) ?? hits[0];
  const body = fresh?.body ?? bodyUnder(spot);
  if (shape === "body") return body?.name ?? "ground";
  if (shape === "point") {
    const { at } = snapHere(spot);
    places.push({ at: fresh?.at ?? at, hits: [] });
    const names = changes.map(({ path }) => String(path.at(-1)));
    const found = pointReference({ at, hits: fresh ? [fresh] : [] }, body, present(), names);
    changes.push(...found.changes);
    return found.reference;
  }
  const element = elementUnder(spot);
  if (shape === "joint")
    return element?.group === "joints" ? element.name : jointAt(hits.map(({ body: b, point }) => `${b.name}.${point}`));
  if (shape === "curve") return body ? curveOf(body.name) : null;
  return coordinateOf((body && !body.ground ? body.name : null) ?? element?.name ?? null);
}

function jointAt(names: string[]): string | null {
  const joints = isTable(tree.value?.joints) ? Object.entries(tree.value.joints) : [];
  return joints.find(([, value]) => isTable(value) && names.includes(String(value.i)))?.[0] ?? null;
}

function curveOf(body: string): string | null {
  const curves = entry(tree.value, "bodies", body)?.curves;
  const first = isTable(curves) ? Object.keys(curves)[0] : undefined;
  return first ? `${body}.${first}` : null;
}

/** The position quantity of a body or element: an angle if it has one. */
async function coordinateOf(name: string | null): Promise<string | null> {
  if (!name) return null;
  const { ok } = await send("quantities", {});
  const own = ok.filter((one) => one.name.startsWith(`${name}.`) && (one.unit === "rad" || one.unit === "m"));
  const found = own.find(({ unit }) => unit === "rad") ?? own[0];
  if (!found) return null;
  now = (await send("quantity", { name: found.name })).ok.value;
  return found.name;
}

/** Begin anew with the active tool, or with another one. */
export function restart(next: Tool | null = tool.value): void {
  [places, chosen, changes, now] = [[], {}, [], null];
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

/** Whether a line is being drawn, whose length may be typed. */
export function drawing(): boolean {
  return places.length > 0 && tool.value?.placing !== null;
}
