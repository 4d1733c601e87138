// Changes of the text that add bodies, points and elements.
import { type Catalogue, type Field, isPin } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { entries, entry, freeName, freePointNames, isTable } from "../catalogue/tree";
import type { Body, Change, Tree, Value } from "../core/protocol";
import type { PointHit } from "../plane/hits";
import { distance, inFrame, type Placement, type Point, placed, rounded } from "../plane/points";
import { isPlain } from "./moving";

/** A clicked place, with the points at this place. */
export interface Place {
  at: Point;
  hits: PointHit[];
}

export interface Added {
  changes: Change[];
  name: string;
}

/** The parts of the case that a change of the drawing needs. */
export interface Case {
  tree: Tree | null;
  bodies: readonly Body[];
  poses: readonly Placement[];
}

export const GROUND = "ground";

/** Add a body with points at these places, pinned to the bodies that have points there. */
export function addBody(
  { type, placing, stem }: Tool,
  places: Place[],
  catalogue: Catalogue,
  { tree, bodies }: Case,
): Added {
  if (placing === "fixed") return addGroundPoint(places[0]!.at, { tree, bodies });
  const name = freeName(tree, stem);
  const names = namesFor(places, tree, bodies);
  const value: Tree = { type: type.name };
  for (const field of type.fields) {
    const found = ownValue(
      field,
      places.map(({ at }) => at),
    );
    if (found !== null) value[field.name] = found;
  }
  if (placing === "one") value.at = places[0]!.at;
  else Object.assign(value, placedBody({ type, placing }, names, places));
  const point = placing === "one" ? onlyPoint(type.doc) : null;
  const changes: Change[] = [{ path: ["bodies", name], value }];
  const taken = new Set<string>();
  places.forEach((place, k) => changes.push(...pinTo(place, name, point ?? names[k]!, catalogue, tree, taken)));
  return { changes, name };
}

/** The name of the one point of a point mass, from its description. */
function onlyPoint(doc: string): string {
  return /point, (\w+)/.exec(doc)?.[1] ?? "P";
}

function placedBody({ type, placing }: Pick<Tool, "type" | "placing">, names: string[], places: Place[]): Tree {
  const at = places.map((place) => place.at);
  if (isElastic(type.fields)) return { through: at, ends: names };
  const table = Object.fromEntries(at.map((one, k) => [names[k]!, one as Value]));
  return placing === "two" ? { through: table } : { through: table, center: middleIn(at) };
}

/** Whether a body bends: it has a cross section. */
function isElastic(fields: readonly Field[]): boolean {
  return fields.some(({ shape }) => shape === "section");
}

/** The middle of some places in the frame of their body, whose x axis points from the first to the second place. */
function middleIn(at: Point[]): Point {
  const [a, b] = at as [Point, Point];
  const [x, y] = inFrame(frameOf(a, b), middleOf(at));
  const step = distance(a, b) * 1e-4;
  return [rounded(x, step), rounded(y, step)];
}

function frameOf([ax, ay]: Point, [bx, by]: Point): Placement {
  return [(ax + bx) / 2, (ay + by) / 2, Math.atan2(by - ay, bx - ax)];
}

function middleOf(at: Point[]): Point {
  return [mean(at.map(([x]) => x)), mean(at.map(([, y]) => y))];
}

/** Mass and moment of inertia of a new body: 1 kg, spread over its points. A new beam is of steel, slender and damped. */
function ownValue({ unit, shape }: Field, at: Point[]): Value | null {
  if (unit === "kg") return 1;
  if (unit === "Pa") return "210 GPa";
  if (unit === "kg/m^3") return 7850;
  const long = distance(at[0]!, at.at(-1)!);
  const part = (share: number) => Number((share * long).toPrecision(2));
  if (shape === "section") return { rectangle: [part(1 / 50), part(1 / 50)] };
  if (unit === "s") return part(1e-3);
  if (unit !== "kg*m^2") return null;
  const middle = middleOf(at);
  return Number(Math.max(1e-6, mean(at.map((one) => distance(one, middle) ** 2)) / 2).toPrecision(3));
}

function mean(values: number[]): number {
  return values.reduce((sum, one) => sum + one, 0) / values.length;
}

/** The names of all points. Those of a beam are bodies, such as `beam.B`. */
function pointNames(bodies: readonly Body[]): string[] {
  return bodies.flatMap(({ name, points }) => [...Object.keys(points), ...name.split(".").slice(1)]);
}

/** Names of the points of a new body: those of the places where it is pinned, otherwise new letters. */
function namesFor(places: Place[], tree: Tree | null, bodies: readonly Body[]): string[] {
  const taken = pointNames(bodies);
  const fresh = freePointNames(tree, taken, places.length);
  const used = new Set<string>();
  return places.map(({ hits }) => {
    const old = hits[0]?.point;
    const name = old !== undefined && !used.has(old) ? old : fresh.shift()!;
    used.add(name);
    return name;
  });
}

/** A pin between the first point of a place and a point of a body. */
export function pinTo(
  { hits }: Pick<Place, "hits">,
  body: string,
  point: string,
  catalogue: Catalogue,
  tree: Tree | null,
  taken: Set<string>,
): Change[] {
  const other = hits.find((hit) => hit.body.name !== body);
  const type = catalogue.joints.find(isPin);
  if (!other || !type) return [];
  const plain = ![...entryNames(tree), ...taken].includes(point) && point !== body;
  const name = plain ? point : freeName(tree, point, [...taken, body]);
  taken.add(name);
  const value = { type: type.name, i: `${other.body.name}.${other.point}`, j: `${body}.${point}` };
  return [{ path: ["joints", name], value }];
}

function entryNames(tree: Tree | null): string[] {
  return ["bodies", "joints", "drivers", "forces", "measures", "parameters"].flatMap((group) =>
    Object.keys(entries(tree, group)),
  );
}

function addGroundPoint(at: Point, { tree, bodies }: Pick<Case, "tree" | "bodies">): Added {
  const taken = pointNames(bodies);
  const [name] = freePointNames(tree, taken, 1);
  return { changes: [pointChange(tree, GROUND, name!, at)], name: GROUND };
}

/** The change that adds a point of the plane to a body: to its `through`, otherwise to its `points`. */
export function pointChange(tree: Tree | null, body: string, point: string, at: Point, pose?: Placement): Change {
  const found = entry(tree, "bodies", body);
  const value = pose ? tidied(inFrame(pose, at)) : at;
  const [a, b] = isTable(found?.through) ? Object.values(found.through) : [];
  if (isPlain(a) && isPlain(b)) {
    const place = placed(frameOf(a as Point, b as Point), value);
    return { path: ["bodies", body, "through", point], value: tidied(place) };
  }
  if (!found) return { path: ["bodies", body], value: { points: { [point]: value } } };
  if (!isTable(found.points)) return { path: ["bodies", body, "points"], value: { [point]: value } };
  return { path: ["bodies", body, "points", point], value };
}

function tidied([x, y]: Point): Point {
  return [rounded(x, 1e-9), rounded(y, 1e-9)];
}

/** A reference to a point at a place: an existing one, or a new one of the body there. */
export function pointReference(
  place: Place,
  body: Body | null,
  { tree, bodies, poses }: Case,
  taken: string[],
): { reference: string; changes: Change[] } {
  const hit = place.hits[0];
  if (hit) return { reference: `${hit.body.name}.${hit.point}`, changes: [] };
  const name = body?.name ?? GROUND;
  const used = [...pointNames(bodies), ...taken];
  const [point] = freePointNames(tree, used, 1);
  const pose = body ? poses[bodies.indexOf(body)] : undefined;
  return { reference: `${name}.${point}`, changes: [pointChange(tree, name, point!, tidied(place.at), pose)] };
}
