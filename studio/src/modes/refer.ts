// The references of a click, in the notation of the file.
import { isPin } from "../catalogue/catalogue";
import { entries, entry, isTable } from "../catalogue/tree";
import type { Body } from "../core/protocol";
import type { PointHit } from "../plane/hits";
import { catalogue, mechanism, tree } from "../store/state";
import type { Spot } from "./handler";
import { bodyUnder, elementUnder, pointsUnder, targets } from "./seen";

/** Points and body under the pointer. Bodies that are not yet chosen come first. */
export interface Under {
  spot: Spot;
  hits: PointHit[];
  fresh: PointHit | undefined;
  body: Body | null;
}

/** A moving body comes before the ground unless it is pinned to it there; with `moves`, also then. */
export function under(spot: Spot, taken: ReadonlySet<string>, moves = false): Under {
  const hits = pointsUnder(spot, targets());
  const others = hits.filter(({ body }) => !taken.has(body.name));
  const moving = others.find(({ body }) => !body.ground);
  const prefers = moves || (moving && !isFixed(moving, hits));
  const fresh = (prefers && moving) || (others[0] ?? hits[0]);
  return { spot, hits, fresh, body: fresh?.body ?? bodyUnder(spot, taken) ?? bodyUnder(spot) };
}

/** Whether the type of a joint is that of a pin. */
function isPinned(type: unknown): boolean {
  return catalogue.value.joints.some((one) => one.name === type && isPin(one));
}

/** Whether a pin holds a point at one of some points of the ground. */
function isFixed(point: PointHit, hits: readonly PointHit[]): boolean {
  const name = ({ body, point: own }: PointHit) => `${body.name}.${own}`;
  const others = hits.filter(({ body }) => body.ground).map(name);
  return Object.values(entries(tree.value, "joints")).some(({ type, i, j }) => {
    const ends = [String(i), String(j)];
    return isPinned(type) && ends.includes(name(point)) && ends.some((end) => others.includes(end));
  });
}

/** The pin between two points, if there is one. */
export function pinBetween(a: unknown, b: unknown): string | undefined {
  return Object.entries(entries(tree.value, "joints")).find(
    ([, { type, i, j }]) => isPinned(type) && ((i === a && j === b) || (i === b && j === a)),
  )?.[0];
}

/** Whether a joint is at a point of a body. */
export function isJoined(hit: PointHit | undefined): boolean {
  if (!hit) return false;
  const name = `${hit.body.name}.${hit.point}`;
  return Object.values(entries(tree.value, "joints")).some(({ i, j }) => i === name || j === name);
}

/** The point about which a body turns: one that is pinned, to the ground if possible. */
export function pivotOf({ name, points }: Body): string | null {
  const joints = Object.values(entries(tree.value, "joints")).filter(({ type }) => isPinned(type));
  const sides = joints.map(({ i, j }) => [String(i), String(j)]);
  const ground = mechanism.value?.bodies.find((body) => body.ground)?.name;
  const own = Object.keys(points).filter((point) => sides.some((pair) => pair.includes(`${name}.${point}`)));
  const fixed = own.find((point) =>
    sides.some((pair) => pair.includes(`${name}.${point}`) && pair.some((one) => one.startsWith(`${ground}.`))),
  );
  return fixed ?? own[0] ?? null;
}

/** The joint of a symbol or at a point. */
export function jointUnder({ spot, hits }: Under): string | null {
  const element = elementUnder(spot);
  if (element?.group === "joints") return element.name;
  const names = hits.map(({ body, point }) => `${body.name}.${point}`);
  const joints = isTable(tree.value?.joints) ? Object.entries(tree.value.joints) : [];
  return joints.find(([, value]) => isTable(value) && names.includes(String(value.i)))?.[0] ?? null;
}

/** A curve of the clicked body; if it has none, a curve of another body with a point there. */
export function curveUnder({ hits, body }: Under): string | null {
  for (const name of [body?.name, ...hits.map((hit) => hit.body.name)]) {
    const curves = name === undefined ? undefined : entry(tree.value, "bodies", name)?.curves;
    const first = isTable(curves) ? Object.keys(curves)[0] : undefined;
    if (first) return `${name}.${first}`;
  }
  return null;
}

/** The body or element whose coordinates a click selects. */
export function ownerUnder({ spot, body }: Under): string | null {
  return (body && !body.ground ? body.name : elementUnder(spot)?.name) ?? null;
}
