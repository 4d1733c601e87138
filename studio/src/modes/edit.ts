// Edit mode: a click selects, and a drag changes the geometry in the text.
import { entries } from "../catalogue/tree";
import type { Change } from "../core/protocol";
import { snapStep } from "../draw/measure";
import { heldShift } from "../edit/holding";
import { drawnThrough, type Fixed, moved } from "../edit/moving";
import type { PointHit } from "../plane/hits";
import { distance, type Point } from "../plane/points";
import { snapped } from "../plane/snap";
import { change, Draft } from "../store/document";
import { preview, view } from "../store/sheet";
import { announce, held, mechanism, poses, selection, snapping, tree } from "../store/state";
import { texts } from "../texts";
import type { Handler, Spot } from "./handler";
import { bodyUnder, elementUnder, points, pointsUnder } from "./seen";

/** A drag: the places of the drawing that move together, each with the points that are pinned there. */
interface Drag {
  draft: Draft;
  began: Point;
  places: { at: Point; hits: PointHit[] }[];
  still: Point[];
  all: PointHit[];
  placements: typeof poses.value;
}

let drag: Drag | null = null;
let fixed: Fixed | null = null;

export const edit: Handler = {
  down(spot) {
    const hits = pointsUnder(spot);
    const body = hits.length ? null : bodyUnder(spot);
    if (!hits.length && !body) return false;
    const all = points();
    const own = hits.length ? hits : all.filter((hit) => hit.body.name === body!.name);
    drag = { draft: new Draft(), began: spot.at, places: placesOf(own, all), still: [], all, placements: poses.value };
    drag.still = all.filter((hit) => !drag!.places.some(({ hits }) => hits.includes(hit))).map(({ at }) => at);
    fixed = null;
    return true;
  },
  drag(spot) {
    if (!drag) return;
    const changes = changesOf(drag, spot);
    if (changes.length) drag.draft.show(changes);
  },
  up() {
    void drag?.draft.keep();
    if (fixed) explain(fixed);
    drag = null;
    preview.value = null;
  },
  cancel() {
    void drag?.draft.drop();
    drag = null;
    preview.value = null;
  },
  click(spot) {
    select(spot);
  },
  cursor() {
    return "default";
  },
};

/** The places of points, each with all points at this place. */
function placesOf(own: PointHit[], all: PointHit[]): { at: Point; hits: PointHit[] }[] {
  const places: { at: Point; hits: PointHit[] }[] = [];
  for (const { at } of own) {
    if (places.some((place) => near(place.at, at))) continue;
    places.push({ at, hits: all.filter((other) => near(other.at, at)) });
  }
  return places;
}

function near(a: Point, b: Point): boolean {
  return distance(a, b) * view.scale < 0.5;
}

function changesOf({ began, places, still, all, placements }: Drag, spot: Spot): Change[] {
  const first = places[0]!;
  const to: Point = [first.at[0] + spot.at[0] - began[0], first.at[1] + spot.at[1] - began[1]];
  const free = spot.free || !snapping.value;
  const { at, kind } = snapped(to, {
    points: places.length > 1 ? [] : still,
    step: snapStep(view),
    scale: view.scale,
    free,
  });
  const wanted: Point = [at[0] - first.at[0], at[1] - first.at[1]];
  const shift = heldShift(wanted, places, all, held.value);
  const limited = shift[0] !== wanted[0] || shift[1] !== wanted[1];
  const end: Point = limited ? [first.at[0] + shift[0], first.at[1] + shift[1]] : at;
  preview.value = { line: [], mark: { at: end, kind: limited ? "held" : kind } };
  return places.flatMap((place) => {
    const target: Point =
      place === first && !limited ? at : [round(place.at[0] + shift[0]), round(place.at[1] + shift[1])];
    const found = moved(tree.value, place.hits, placements, mechanism.value?.bodies ?? [], target);
    fixed = found.fixed[0] ?? fixed;
    return found.fixed.length ? [] : found.changes;
  });
}

function round(value: number): number {
  return Number(value.toPrecision(12));
}

/** Explain why a point did not follow the mouse, and offer a remedy. */
function explain({ body, point }: Fixed): void {
  const changes = drawnThrough(tree.value, points(), body);
  const run = () => void change(changes);
  announce(
    "info",
    texts.edit.fixed(body, point),
    changes.length ? { action: { label: texts.edit.place(body), run } } : {},
  );
}

/** Select the joint at a point, the point, the symbol or the body under the pointer. */
function select(spot: Spot): void {
  const hits = pointsUnder(spot);
  if (hits.length) {
    const names = hits.map(({ body, point }) => `${body.name}.${point}`);
    const joints = Object.entries(entries(tree.value, "joints"));
    const joint = joints.find(
      ([, value]) => Object.values(value).filter((one) => names.includes(String(one))).length > 1,
    );
    const { body, point } = hits[0]!;
    selection.value = joint ? { group: "joints", name: joint[0] } : { group: "bodies", name: body.name, point };
    return;
  }
  const body = bodyUnder(spot);
  selection.value = elementUnder(spot) ?? (body ? { group: "bodies", name: body.name } : null);
}
