// Edit mode: a click selects, and a drag changes the geometry in the text.
import { effect } from "@preact/signals";
import { entries } from "../catalogue/tree";
import type { Body, Change } from "../core/protocol";
import { snapStep } from "../draw/measure";
import { GROUND, pinTo } from "../edit/adding";
import { chosenPoints, nudge } from "../edit/commands";
import { heldShift, ofPoint } from "../edit/holding";
import { drawnThrough, moved } from "../edit/moving";
import type { PointHit } from "../plane/hits";
import { distance, type Point } from "../plane/points";
import { snapped } from "../plane/snap";
import { change, Draft, undo } from "../store/document";
import { note } from "../store/note";
import { report } from "../store/session";
import { preview, view } from "../store/sheet";
import {
  announce,
  catalogue,
  held,
  loads,
  mechanism,
  mode,
  poses,
  selection,
  snapping,
  tool,
  tree,
  unassembled,
} from "../store/state";
import { texts } from "../texts";
import { Follower } from "./following";
import type { Handler, Spot } from "./handler";
import { type Grasp, graspOf, type Knob, nameOf, naturalOf, otherWays, placeOf } from "./knobs";
import { bodyUnder, elementUnder, links, points, pointsUnder } from "./seen";

/** A drag: the places of the drawing that move together, each with the points that are pinned there. */
interface Drag {
  draft: Draft;
  began: Point;
  places: { at: Point; hits: PointHit[] }[];
  still: Point[];
  all: PointHit[];
  placements: typeof poses.value;
  latest: Spot | null;
  /** Resolves when it is known what the drag changes. */
  ready: Promise<void>;
  known: boolean;
  /** With numbers that determine the place; null while plain coordinates follow the pointer. */
  follower: Follower | null;
  /** Why the place cannot follow. */
  locked: string;
  /** The points to which the dragged one is pinned when it is dropped. */
  meets: PointHit[];
}

let drag: Drag | null = null;

export const edit: Handler = {
  down(spot) {
    note.value = null;
    const hits = pointsUnder(spot);
    const body = hits.length ? null : bodyUnder(spot);
    if (!hits.length && !body) return false;
    const all = points();
    const own = hits.length ? hits : ownOf(body!, spot, all);
    const places = placesOf(own, all);
    const still = all.filter((hit) => !places.some((place) => place.hits.includes(hit))).map(({ at }) => at);
    const rest = {
      latest: null,
      ready: Promise.resolve(),
      known: places.length > 1,
      follower: null,
      locked: "",
      meets: [],
    };
    drag = { draft: new Draft(), began: spot.at, places, still, all, placements: poses.value, ...rest };
    const plain = !moved(tree.value, places[0]!.hits, poses.value, bodiesNow(), places[0]!.at).fixed.length;
    if (isLarge() && plain) drag.known = true;
    else if (places.length === 1) drag.ready = begin(drag).catch(report);
    return true;
  },
  drag(spot) {
    if (!drag) return;
    drag.latest = spot;
    if (drag.known) follow(drag);
  },
  up() {
    const one = drag;
    drag = null;
    if (one) void one.ready.then(() => end(one));
    preview.value = null;
  },
  cancel() {
    const one = drag;
    drag = null;
    if (one) void one.ready.then(() => (one.follower ?? one.draft).drop());
    preview.value = null;
  },
  click(spot) {
    select(spot);
  },
  hover(spot) {
    const hits = spot ? pointsUnder(spot) : [];
    const key = hits.map(({ body, point }) => `${body.name}.${point}`).join();
    if (!note.value?.actions?.length) note.value = null;
    over = { key, locked: key === over.key && over.locked };
    if (!spot || !key || isLarge()) return;
    void placeUnder(hits).then((found) => {
      if (drag || over.key !== key || mode.value !== "edit" || tool.value || !found) return;
      const [names, locked] = [nameOf(naturalOf(found).filter(({ numeral }) => numeral)), lockOf(found)];
      over.locked = locked !== "";
      if (locked) note.value = { at: spot.px, text: locked, kind: "lock" };
      else if (names) note.value = { at: spot.px, text: texts.edit.changes(names) };
    }, report);
  },
  cursor() {
    return over.locked ? "not-allowed" : over.key ? "move" : "default";
  },
};

/** The point under the pointer, and whether it cannot be dragged. */
let over = { key: "", locked: false };

/** The points that a drag of a body moves: all of them if they are plain numbers, otherwise the nearest one. */
function ownOf(body: Body, spot: Spot, all: PointHit[]): PointHit[] {
  const own = all.filter((hit) => hit.body.name === body.name);
  const shifted = placesOf(own, all).flatMap(
    ({ at, hits }) => moved(tree.value, hits, poses.value, bodiesNow(), at).fixed,
  );
  if (!shifted.length) return own;
  return own.sort((a, b) => distance(a.at, spot.at) - distance(b.at, spot.at)).slice(0, 1);
}

/** Whether trials of numbers take long; then they are made only where a drag needs them. */
function isLarge(): boolean {
  return bodiesNow().length > 40;
}

function bodiesNow(): readonly Body[] {
  return mechanism.value?.bodies ?? [];
}

/** What a drag of these points may change, without what is kept while drawing. */
async function placeUnder(hits: PointHit[]): Promise<Grasp | null> {
  const found = await graspOf(hits, hits[0]!.at);
  return found && { ...found, knobs: found.knobs.filter(({ numeral }) => !held.value.has(numeral?.kept ?? "")) };
}

/** Why a place cannot be dragged; empty if it can. */
function lockOf({ hits, knobs }: Grasp): string {
  const { body, point } = hits[0]!;
  if (hits.some((hit) => held.value.has(ofPoint(hit.body.name, hit.point))))
    return texts.edit.heldPoint(body.name, point);
  return knobs.length || unassembled.value ? "" : texts.edit.locked(body.name, point);
}

/** Find out what the drag of one place changes. */
async function begin(one: Drag): Promise<void> {
  const grasp = await placeUnder(one.places[0]!.hits);
  const natural = grasp ? naturalOf(grasp) : [];
  if (grasp) one.locked = lockOf(grasp);
  if (natural[0]?.numeral) one.follower = new Follower(grasp!, natural, () => drag === one && showNumbers(one));
  one.known = true;
  follow(one);
}

/** Bring the places to the pointer. */
function follow(one: Drag): void {
  const { latest, follower, locked, places, began } = one;
  if (!latest) return;
  if (locked) note.value = { at: latest.px, text: locked, kind: "lock" };
  else if (follower) follower.to(shifted(places[0]!.at, began, latest.at));
  else {
    const changes = changesOf(one, latest);
    if (changes.length) one.draft.show(changes);
  }
}

function shifted(at: Point, began: Point, now: Point): Point {
  return [at[0] + now[0] - began[0], at[1] + now[1] - began[1]];
}

/** Show the numbers that a drag changes, and a line to the pointer where the place cannot follow. */
function showNumbers({ follower, latest }: Drag): void {
  const at = placeOf(follower!.grasp);
  const far = at && distance(at, follower!.end) * view.scale > 6;
  preview.value = far ? { line: [], pull: [at, follower!.end] } : null;
  note.value = { at: latest!.px, text: follower!.label };
}

/** Keep what a drag has changed, and offer other choices. */
async function end(one: Drag): Promise<void> {
  const { follower, latest, draft } = one;
  preview.value = null;
  if (!follower || !latest) {
    const hit = one.places[0]!.hits.find(({ body }) => !body.ground) ?? one.places[0]!.hits[0]!;
    if (one.meets.length) {
      const pin = pinTo({ hits: one.meets }, hit.body.name, hit.point, catalogue.value, tree.value, new Set());
      await draft.apply(pin);
    }
    await draft.keep();
    if (one.locked) explain(one);
    return;
  }
  await follower.keep();
  offer(follower, latest.px);
}

function offer(follower: Follower, px: Point): void {
  const { grasp, end: goal } = follower;
  const actions = otherWays(grasp, follower.changed)
    .slice(0, MOST_WAYS)
    .map((way) => ({
      label: nameOf(way),
      run: () => void take(way).catch(report),
    }));
  const take = async (way: Knob[]) => {
    note.value = null;
    if (follower.changed.length) await undo();
    const next = new Follower(grasp, way, () => {});
    next.to(goal);
    await next.keep();
    offer(next, px);
  };
  const names = follower.label;
  note.value = actions.length ? { at: px, text: names && `${names}   ${texts.edit.instead}`, actions } : null;
}

/** Move the selection by steps of the grid. A single place changes the numbers that determine it. */
export async function push(dx: number, dy: number): Promise<void> {
  const [place, ...others] = placesOf(chosenPoints(points()), points());
  const grasp = place && !others.length ? await placeUnder(place.hits) : null;
  const natural = grasp ? naturalOf(grasp) : [];
  if (!grasp || !natural[0]?.numeral) return nudge(dx, dy);
  const step = snapStep(view);
  const follower = new Follower(grasp, natural, () => {});
  follower.to([place!.at[0] + dx * step, place!.at[1] + dy * step]);
  await follower.keep();
  note.value = { at: view.toScreen(follower.end), text: follower.label };
}

/** Other choices that are offered at most. */
const MOST_WAYS = 4;

/** Another text ends the choices of the last drag. */
effect(() => {
  loads.value;
  if (!drag) note.value = null;
});

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

function changesOf(one: Drag, spot: Spot): Change[] {
  const { began, places, still, all, placements } = one;
  const first = places[0]!;
  const to: Point = [first.at[0] + spot.at[0] - began[0], first.at[1] + spot.at[1] - began[1]];
  const free = spot.free || !snapping.value;
  const { at, kind } = snapped(to, {
    points: places.length > 1 || spot.free ? [] : still,
    lines: places.length > 1 || free ? [] : links(new Set(first.hits.map(({ body }) => body.name))),
    from: places.length > 1 ? undefined : otherEnd(first.hits, all),
    step: snapStep(view),
    scale: view.scale,
    free,
  });
  const wanted: Point = [at[0] - first.at[0], at[1] - first.at[1]];
  const shift = heldShift(wanted, places, all, held.value);
  const limited = shift[0] !== wanted[0] || shift[1] !== wanted[1];
  const end: Point = limited ? [first.at[0] + shift[0], first.at[1] + shift[1]] : at;
  preview.value = { line: [], mark: { at: end, kind: limited ? "held" : kind } };
  const own = new Set(first.hits.map(({ body }) => body.name));
  const others = all.filter((hit) => near(hit.at, at) && !own.has(hit.body.name));
  one.meets =
    kind === "point" && !limited && !(own.has(GROUND) && own.size === 1 && others.every(({ body }) => body.ground))
      ? others
      : [];
  const [other] = one.meets;
  note.value = other ? { at: spot.px, text: texts.edit.meets(`${other.body.name}.${other.point}`) } : null;
  return places.flatMap((place) => {
    const target: Point =
      place === first && !limited ? at : [round(place.at[0] + shift[0]), round(place.at[1] + shift[1])];
    const found = moved(tree.value, place.hits, placements, mechanism.value?.bodies ?? [], target);
    return found.changes;
  });
}

/** The other end of a body with two points, for directions at round angles. */
function otherEnd([hit, ...others]: readonly PointHit[], all: readonly PointHit[]): Point | undefined {
  if (!hit || others.length || hit.body.ground) return undefined;
  const rest = all.filter((one) => one.body.name === hit.body.name && one.point !== hit.point);
  return rest.length === 1 ? rest[0]!.at : undefined;
}

function round(value: number): number {
  return Number(value.toPrecision(12));
}

/** Explain why a point did not follow the mouse, and offer a remedy. */
function explain({ places, locked }: Drag): void {
  const body = places[0]!.hits.find((hit) => !hit.body.ground)?.body.name ?? GROUND;
  const changes = drawnThrough(tree.value, points(), body);
  const run = () => void change(changes);
  announce("info", locked, changes.length ? { action: { label: texts.edit.place(body), run } } : {});
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
