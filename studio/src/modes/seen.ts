// Points, bodies and elements under the pointer in the present pose.

import type { Group } from "../catalogue/catalogue";
import type { Body } from "../core/protocol";
import { allPoints, bodyAt, elementAt, type PointHit, pointsAt, reachOf } from "../plane/hits";
import { hull, type Point, placed } from "../plane/points";
import { view } from "../store/sheet";
import { items, mechanism, poses } from "../store/state";
import type { Spot } from "./handler";

export function points(): PointHit[] {
  return allPoints(mechanism.value?.bodies ?? [], poses.value);
}

/** The points that a tool can use: also those of a beam, which are bodies; its nameless parts have a #. */
export function targets(): PointHit[] {
  const bodies = mechanism.value?.bodies ?? [];
  const nodes = bodies.flatMap(({ name }, k): PointHit[] => {
    const [owner, point] = name.split(".");
    const body = bodies.find((one) => one.name === owner);
    const pose = poses.value[k];
    return body && pose && point && point[0] !== "#" ? [{ body, point, at: [pose[0], pose[1]] }] : [];
  });
  return [...points(), ...nodes];
}

/** The links of bodies, as lines between their points, without some bodies. */
export function links(without: ReadonlySet<string> = new Set()): [Point, Point][] {
  return (mechanism.value?.bodies ?? []).flatMap((body, k) => {
    const pose = poses.value[k];
    if (body.ground || without.has(body.name) || !pose) return [];
    const corners = hull(Object.values(body.points).map((at) => placed(pose, at)));
    return corners
      .slice(corners.length > 2 ? 0 : 1)
      .map((at, n): [Point, Point] => [at, corners.at(corners.length > 2 ? n - 1 : 0)!]);
  });
}

export function pointsUnder(spot: Spot, among = points()): PointHit[] {
  return pointsAt(spot.px, among, view, reachOf(spot.touch));
}

/** The topmost body under the pointer, without some bodies. */
export function bodyUnder(spot: Spot, without: ReadonlySet<string> = new Set()): Body | null {
  const bodies = mechanism.value?.bodies ?? [];
  return bodyAt(spot.px, bodies, poses.value, items.value, view, reachOf(spot.touch), without);
}

/** The element whose symbol is under the pointer. */
export function elementUnder(spot: Spot): { group: Group; name: string } | null {
  const found = mechanism.value;
  if (!found) return null;
  const groups: Group[] = ["forces", "drivers", "joints"];
  for (const group of groups) {
    const names = found[group as "forces"].map(({ name }) => name);
    const name = elementAt(spot.px, names, items.value, poses.value, view, reachOf(spot.touch) - 3);
    if (name) return { group, name };
  }
  return null;
}
