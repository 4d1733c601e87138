// The references of a click, in the notation of the file.
import { entry, isTable } from "../catalogue/tree";
import type { Body } from "../core/protocol";
import type { PointHit } from "../plane/hits";
import { tree } from "../store/state";
import type { Spot } from "./handler";
import { bodyUnder, elementUnder, pointsUnder } from "./seen";

/** Points and body under the pointer. Bodies that are not yet chosen come first. */
export interface Under {
  spot: Spot;
  hits: PointHit[];
  fresh: PointHit | undefined;
  body: Body | null;
}

export function under(spot: Spot, taken: ReadonlySet<string>): Under {
  const hits = pointsUnder(spot);
  const fresh = hits.find(({ body }) => !taken.has(body.name)) ?? hits[0];
  return { spot, hits, fresh, body: fresh?.body ?? bodyUnder(spot) };
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
