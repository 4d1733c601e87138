// Commands on the selection: rename, remove, copy, mirror, move by keys.
import { type Group, typeOf } from "../catalogue/catalogue";
import { entry, freeName, freePointNames, groupOf, isTable } from "../catalogue/tree";
import type { Change, Tree, Value } from "../core/protocol";
import { gridStep, snapStep } from "../draw/measure";
import { allPoints, type PointHit } from "../plane/hits";
import { distance, type Point, placed } from "../plane/points";
import { change } from "../store/document";
import { view } from "../store/sheet";
import { announce, catalogue, held, mechanism, poses, selection, tree, units } from "../store/state";
import { texts } from "../texts";
import { pointChange } from "./adding";
import { curveFor } from "./curve";
import { heldShift } from "./holding";
import { lengthened } from "./length";
import { lengthMeant, meantValue } from "./meaning";
import { isPlain, moved } from "./moving";
import { removed, removedPoint, renamed } from "./removing";
import { swapped } from "./swapping";

const RESERVED = ["t", "pi", "deg", "ground", "energy", "drift"];

/** Whether an entry may have this name. */
export function isName(name: string, group = "bodies"): boolean {
  const taken = groupOf(tree.value, name) ?? entry(tree.value, "parameters", name);
  const allowed = group === "parameters" ? /^[A-Za-z_]\w{0,40}$/ : /^[\p{L}_][\p{L}\p{M}\p{N}_]{0,40}$/u;
  return allowed.test(name) && !RESERVED.includes(name) && !taken;
}

/** Rename an entry and all that mentions it; false if the name cannot be used. */
export async function rename(group: string, name: string, given: string): Promise<boolean> {
  const next = given.normalize("NFC");
  if (name === next) return true;
  if (!isName(next, group)) {
    announce("problem", texts.edit.invalidName(next));
    return false;
  }
  const done = await change(renamed(tree.value, group, name, next));
  if (done && selection.value?.name === name) selection.value = { ...selection.value, name: next };
  return done;
}

/** Remove the selection and everything that refers to it. */
export async function remove(): Promise<void> {
  const chosen = selection.value;
  if (!chosen) return;
  const { group, name, point } = chosen;
  selection.value = null;
  const changes = point ? removedPoint(tree.value, name, point) : removed(tree.value, group, name);
  const others = changes.flatMap(({ path }) => (path.length === 2 && path[1] !== name ? path[1]! : []));
  const done = await change(changes);
  if (done && others.length) announce("done", texts.edit.removed(point ? `${name}.${point}` : name, others));
}

/** A copy of a body beside it, without its joints. */
export async function copy(name: string): Promise<void> {
  const found = entry(tree.value, "bodies", name);
  if (found) await paste(name, found);
}

let copied: { name: string; body: Tree } | null = null;

/** Remember a body for pasting. */
export function takeCopy(name: string): void {
  const body = entry(tree.value, "bodies", name);
  if (body) copied = { name, body };
}

export function canPaste(): boolean {
  return copied !== null;
}

export function pasteCopied(): void {
  if (copied) void paste(copied.name, copied.body);
}

async function paste(name: string, body: Tree): Promise<void> {
  const step = 10 * snapStep(view);
  const shifted = mapped(body, ["through", "at"], ([x, y]) => [tidy(x + step), tidy(y - step)]);
  const fresh = freeName(tree.value, name.replace(/\d+$/, ""));
  if (await change([{ path: ["bodies", fresh], value: shifted }])) selection.value = { group: "bodies", name: fresh };
}

/** Mirror a body at the vertical line through the middle of its points. Bodies that are pinned to it stay. */
export async function mirror(name: string): Promise<void> {
  const found = entry(tree.value, "bodies", name);
  const own = allPoints(mechanism.value?.bodies ?? [], poses.value).filter(({ body }) => body.name === name);
  if (!found || !own.length) return;
  const across = own.map(({ at }) => at[0]);
  const sum = Math.min(...across) + Math.max(...across);
  if (ONE_SIDED.some((key) => key in found) || !("through" in found || "at" in found)) {
    announce("problem", texts.edit.noMirror(name));
    return;
  }
  // The x axis of the frame points from the first to the second place; local places therefore change sides.
  const placed = mapped(found, ["through", "at"], ([x, y]) => [tidy(sum - x), y]);
  const after = mapped(placed, ["points", "center"], ([x, y]) => [x, y && -y]);
  const changes = Object.keys(after).filter((key) => JSON.stringify(after[key]) !== JSON.stringify(found[key]));
  await change(changes.map((key): Change => ({ path: ["bodies", name, key], value: after[key]! })));
}

/** Parts of a body that are no points; a body with one of them cannot be mirrored. */
const ONE_SIDED = ["shapes", "outline", "curves"];

/** A body with some of its places changed; formulas stay. */
function mapped(body: Tree, keys: string[], map: (at: Point) => Point): Tree {
  const pair = (value: Value): Value => (isPlain(value) ? map(value as Point) : value);
  const value = (one: Value): Value =>
    isTable(one) ? Object.fromEntries(Object.entries(one).map(([key, at]) => [key, pair(at)])) : pair(one);
  return Object.fromEntries(Object.entries(body).map(([key, one]) => [key, keys.includes(key) ? value(one) : one]));
}

function tidy(value: number): number {
  return Number(value.toPrecision(12));
}

/** Give a body that is placed by two points another length, as it is typed. */
export async function setLength(name: string, given: string): Promise<void> {
  const length = meantValue(await lengthMeant(given));
  if (length === undefined) return;
  const bodies = mechanism.value?.bodies ?? [];
  const found = lengthened(name, length, allPoints(bodies, poses.value));
  if (!found) return announce("problem", texts.edit.noLength(units.value.length));
  const to: Point = [tidy(found.to[0]), tidy(found.to[1])];
  const { changes, fixed } = moved(tree.value, found.hits, poses.value, bodies, to);
  if (fixed[0]) return announce("problem", texts.edit.fixed(fixed[0].body, fixed[0].point));
  if ((await change(changes)) && !found.kept) announce("info", texts.edit.notKept(name));
}

/**
 * Bring a point of a body to a typed place, with all that is pinned there. False if another number determines one of these
 * points, or if the place is not one of the plane.
 */
export async function placePoint(body: string, part: string, point: string, to: Value): Promise<boolean> {
  const bodies = mechanism.value?.bodies ?? [];
  const all = allPoints(bodies, poses.value);
  const own = all.find((hit) => hit.body.name === body && hit.point === point);
  if (!own || !(part === "through" || own.body.ground) || !isPlain(to) || (to as Value[]).length !== 2) return false;
  const hits = all.filter(({ at }) => distance(at, own.at) * view.scale < 0.5);
  const { changes, fixed } = moved(tree.value, hits, poses.value, bodies, to as Point);
  return !fixed.length && change(changes);
}

/** Add a point beside the middle of a body, to be dragged to its place. */
export async function addPoint(name: string): Promise<void> {
  const bodies = mechanism.value?.bodies ?? [];
  const k = bodies.findIndex((one) => one.name === name);
  const pose = poses.value[k];
  if (!pose) return;
  const used = bodies.flatMap(({ points }) => Object.keys(points));
  const [point] = freePointNames(tree.value, used, 1);
  const [x, y] = placed(pose, bodies[k]!.center);
  const at: Point = [tidy(x), tidy(y + gridStep(view) / 2)];
  if (await change([pointChange(tree.value, name, point!, at, pose)]))
    selection.value = { group: "bodies", name, point: point! };
}

/** Whether a body may have curves. */
export function takesCurves(name: string): boolean {
  const type = typeOf(catalogue.value, "bodies", name, entry(tree.value, "bodies", name));
  return type?.fields.some(({ shape }) => shape === "curves") ?? false;
}

/** Whether a body takes further points in its frame; a beam and its parts take none. */
export function takesPoints(name: string): boolean {
  const type = typeOf(catalogue.value, "bodies", name, entry(tree.value, "bodies", name));
  return !name.includes(".") && (type?.fields.some(({ shape }) => shape === "points") ?? false);
}

/** Add a curve to a body; returns its name, or null if that failed. */
export async function addCurve(name: string, at?: Point): Promise<string | null> {
  const body = mechanism.value?.bodies.find((one) => one.name === name);
  if (!body) return null;
  const added = curveFor(tree.value, body, gridStep(view), at);
  return (await change([added.change])) ? added.name : null;
}

/** Move the selected point, or all points of the selected body, by steps of the grid. */
export async function nudge(dx: number, dy: number): Promise<void> {
  const chosen = selection.value;
  const step = snapStep(view);
  const bodies = mechanism.value?.bodies ?? [];
  const all = allPoints(bodies, poses.value);
  const own = chosenPoints(all);
  if (!chosen || !own.length) return;
  const places = own.map(({ at }) => ({
    at,
    hits: all.filter((other) => distance(other.at, at) * view.scale < 0.5),
  }));
  const [sx, sy] = heldShift([dx * step, dy * step], places, all, held.value);
  const changes = places.flatMap(({ at, hits }) => {
    return moved(tree.value, hits, poses.value, bodies, [tidy(at[0] + sx), tidy(at[1] + sy)]).changes;
  });
  await change([...new Map(changes.map((one) => [one.path.join("\0"), one])).values()]);
}

/** The points that belong to the selection; a joint has those to which it refers. */
export function chosenPoints(all: PointHit[]): PointHit[] {
  const chosen = selection.value;
  if (!chosen) return [];
  const references = Object.values(entry(tree.value, chosen.group, chosen.name) ?? {});
  return all.filter(({ body: { name }, point }) =>
    chosen.group === "bodies"
      ? chosen.name === name && (!chosen.point || chosen.point === point)
      : references.includes(`${name}.${point}`),
  );
}

/** Exchange the two sides of an element. */
export async function swap(group: Group, name: string): Promise<void> {
  const found = entry(tree.value, group, name);
  const type = typeOf(catalogue.value, group, name, found);
  if (found && type) await change(swapped(type, [group, name], found, mechanism.value?.bodies ?? [], poses.value));
}
