// Machines of several elements that one tool places: a block on a guide, and a cylinder with its rod.
import { type Catalogue, isPin, type Type } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { freeName, freePointNames } from "../catalogue/tree";
import type { Body, Change, Tree, Value } from "../core/protocol";
import { distance, type Point, rounded } from "../plane/points";
import { type Added, type Case, type Place, pointReference } from "./adding";
import { evenLaw } from "./driving";

/** Barrel and rod have this share of the length between the ends. */
const SHARE = 0.6;

/** The type of joint whose bodies slide without turning: its line has an angle in both. */
function slideOf({ joints }: Catalogue): Type | undefined {
  return joints.find((type) => !isPin(type) && type.fields.some(({ name }) => name === "axes"));
}

interface Parts {
  all: Case;
  catalogue: Catalogue;
  changes: Change[];
  points: string[];
  names: string[];
}

function freshName({ all, names }: Parts, stem: string): string {
  const name = freeName(all.tree, stem, names);
  names.push(name);
  return name;
}

function freshPoint({ all, points }: Parts): string {
  const used = [...all.bodies.flatMap((body) => Object.keys(body.points)), ...points];
  const [name] = freePointNames(all.tree, used, 1);
  points.push(name!);
  return name!;
}

/** A body from one place to another; its frame has the x axis along them. */
function link(parts: Parts, stem: string, from: Point, to: Point): { name: string; ends: [string, string] } {
  const name = freshName(parts, stem);
  const ends: [string, string] = [freshPoint(parts), freshPoint(parts)];
  const inertia = Number(Math.max(1e-6, distance(from, to) ** 2 / 12).toPrecision(3));
  const through: Tree = { [ends[0]]: tidied(from), [ends[1]]: tidied(to) };
  parts.changes.push({ path: ["bodies", name], value: { type: "body", mass: 1, inertia, through } });
  return { name, ends };
}

function join(parts: Parts, type: Type | undefined, stem: string, i: string, j: string, more: Tree = {}): string {
  const name = freshName(parts, stem);
  if (type) parts.changes.push({ path: ["joints", name], value: { type: type.name, i, j, ...more } });
  return name;
}

/** A reference to a point at a place: an existing one, or a new one of a body or of the ground. */
function reference(parts: Parts, place: Place, body: Body | null): string {
  const found = pointReference(place, body, parts.all, parts.points);
  parts.changes.push(...found.changes);
  if (found.changes.length) parts.points.push(String(found.changes[0]!.path.at(-1)));
  return found.reference;
}

/** A machine from two places; `bodies` are those under them without a point. */
export function addMachine(
  { placing, stem }: Tool,
  places: readonly [Place, Place],
  bodies: readonly (Body | null)[],
  catalogue: Catalogue,
  all: Case,
): Added {
  const parts: Parts = { all, catalogue, changes: [], points: [], names: [] };
  const [from, to] = places.map(({ at }) => at) as [Point, Point];
  const pin = catalogue.joints.find(isPin);
  if (placing === "slider") return slider(parts, stem, places[0], to, bodies[0] ?? null, pin);
  const between = (share: number): Point => [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
  const barrel = link(parts, stem, from, between(SHARE));
  const rod = link(parts, "rod", between(1 - SHARE), to);
  const ends = [`${barrel.name}.${barrel.ends[0]}`, `${rod.name}.${rod.ends[1]}`];
  // the first end is pinned to the ground where it meets nothing; the second one is free then
  places.forEach((place, k) => {
    const body = bodies[k] ?? null;
    if (k === 0 || body || place.hits.length) join(parts, pin, "pin", reference(parts, place, body), ends[k]!);
  });
  const slide = join(
    parts,
    slideOf(catalogue),
    "slide",
    `${barrel.name}.${barrel.ends[1]}`,
    `${rod.name}.${rod.ends[0]}`,
  );
  drive(parts, slide, (1 - 2 * SHARE) * distance(from, to));
  return { changes: parts.changes, name: barrel.name };
}

/** A block on a straight guide of the ground or of another body. A point of a body at its place is pinned to it. */
function slider(parts: Parts, stem: string, place: Place, to: Point, guide: Body | null, pin: Type | undefined): Added {
  const carried = place.hits.find((hit) => !hit.body.ground);
  const block = link(parts, stem, place.at, to);
  const fixed = place.hits.filter((hit) => hit.body.ground);
  const on = reference(parts, { at: place.at, hits: fixed }, guide);
  if (carried) join(parts, pin, "pin", `${carried.body.name}.${carried.point}`, `${block.name}.${block.ends[0]}`);
  const angle = Math.atan2(to[1] - place.at[1], to[0] - place.at[0]);
  const turned = guide ? (parts.all.poses[parts.all.bodies.indexOf(guide)]?.[2] ?? 0) : 0;
  const axes: Value = [Number((angle - turned).toPrecision(10)), 0];
  join(parts, slideOf(parts.catalogue), "slide", on, `${block.name}.${block.ends[0]}`, { axes });
  return { changes: parts.changes, name: block.name };
}

/** A driver that lengthens a slide evenly. */
function drive(parts: Parts, slide: string, begin: number): void {
  const { all, catalogue } = parts;
  const type = catalogue.drivers[0];
  if (!type) return;
  const value = Number(begin.toPrecision(10));
  const motion = { name: `${slide}.displacement`, unit: "m", value, rate: 0, alone: false };
  const even = evenLaw(motion, { length: Math.abs(begin), degrees: true }, all.tree);
  const name = freshName(parts, "driver");
  parts.changes.push(...even.changes, {
    path: ["drivers", name],
    value: { type: type.name, coordinate: motion.name, value: even.law },
  });
}

function tidied([x, y]: Point): Point {
  return [rounded(x, 1e-9), rounded(y, 1e-9)];
}

export const isMachine = ({ placing }: Tool) => placing === "slider" || placing === "cylinder";
