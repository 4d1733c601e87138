// The points where forces act. An element acts on a point of body j, and with the opposite force on a point of body i.
import { type Group, typeOf } from "../catalogue/catalogue";
import { entry } from "../catalogue/tree";
import type { Triple } from "../core/protocol";
import { chosenEnds, type End } from "../draw/ends";
import { type Point, placed } from "../plane/points";
import { catalogue, mechanism, poses, scene, tree } from "../store/state";

/** A joint or a symbol of the scene: docs/scene.md. */
interface Drawn {
  bodies: [number, number];
  points: [Point | null, Point | null];
}

/** The ends on body j of all elements of groups, or those on one body; `on` is the number of the body. */
export function endsOf(groups: readonly Group[], on: number | null): End[] {
  return groups.flatMap((group) => {
    const drawn = drawnOf(group);
    return [...drawn].flatMap(([element, one]) => chosenEnds(ends(group, element, one), on));
  });
}

/** The joint or the first symbol of each element of a group. */
function drawnOf(group: Group): Map<string, Drawn> {
  const { joints, symbols } = (scene.value ?? {}) as { joints?: Named[]; symbols?: Named[] };
  if (group === "joints") return new Map(joints?.map((one) => [one.name ?? "", one]));
  const names = new Set((group === "bodies" ? [] : (mechanism.value?.[group] ?? [])).map(({ name }) => name));
  // An element may have several symbols, such as a coil and a dashpot; the first is used.
  return new Map(
    [...(symbols ?? [])]
      .reverse()
      .map((one) => [one.element ?? "", one] as const)
      .filter(([name]) => names.has(name)),
  );
}

type Named = Drawn & { name?: string; element?: string };

/** The ends on the bodies i and j. An element without a point of body i acts on body j only. */
function ends(group: Group, element: string, { bodies, points }: Drawn): End[] {
  const written = entry(tree.value, group, element) ?? {};
  const fields = typeOf(catalogue.value, group, element, written)?.fields ?? [];
  // An element on a curve of body j acts at the point of body i.
  const curve = fields.find(({ shape }) => shape === "curve")?.name;
  const end = (body: number, from: number, point: Point | null, sign: End["sign"]): End[] => {
    const pose = poses.value[from];
    return pose && point ? [{ element, body, at: placed(pose as Triple, point), sign }] : [];
  };
  const references = [written.i, written[curve ?? "j"]];
  const [i, j] = references.map((reference, k) => numberOf(reference) ?? bodies[k]!) as [number, number];
  const k = curve ? 0 : 1;
  return [...end(i, bodies[0], points[0], -1), ...end(j, bodies[k], points[k], 1)];
}

/** The number of the body in a reference such as `crank.A`. */
function numberOf(reference: unknown): number | undefined {
  if (typeof reference !== "string") return undefined;
  const [name] = reference.split(".");
  const found = mechanism.value?.bodies.findIndex((body) => body.name === name) ?? -1;
  return found < 0 ? undefined : found;
}
