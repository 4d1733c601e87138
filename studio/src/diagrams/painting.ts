// Paints polygons and free bodies in their panel, and centres with centrodes on the sheet.
import { paintArrow } from "../draw/arrow";
import { paintArrows, paintScale, type Vectors } from "../draw/arrows";
import { displayed, type Units } from "../draw/display";
import type { Item } from "../draw/items";
import { broken, circle, Line } from "../draw/line";
import { quantity, readable } from "../draw/numbers";
import { type Box, paintItems } from "../draw/paint";
import { type Colours, font, rimmed } from "../draw/surface";
import { type Placement, type Point, placed } from "../plane/points";
import { View } from "../plane/view";
import { texts } from "../texts";
import type { Centre } from "./centres";
import type { FreeBody } from "./freeBody";
import { minus, plus, size, times } from "./points";
import { type Part, POLE, type Polygon, type Side } from "./polygons";
import type { Centrodes } from "./shown";

/** Sides and loads below this fraction of the largest are not drawn. */
const NOTHING = 1e-6;
/** The longest arrow of a free body, and the radius of a moment, px. */
const LONGEST = 74;
const RADIUS = 15;
/** Room for arrows around a free body, as a share of its size. */
const ROOM = 0.45;
const GAP = 13;

/** A view of the canvas with all of some points. */
function around(points: readonly Point[], [width, height]: Point, room: number): View {
  const along = (axis: 0 | 1) => points.map((at) => at[axis]).filter(Number.isFinite);
  const ends = (all: number[]) => (all.length ? [Math.min(...all), Math.max(...all)] : [0, 0]) as [number, number];
  const [[x0, x1], [y0, y1]] = [ends(along(0)), ends(along(1))];
  const more = room * (Math.max(x1 - x0, y1 - y0) || 1);
  const view = new View([x0 - more, y0 - more, x1 + more, y1 + more]);
  view.resize(width, height);
  return view;
}

function colourOfPart(part: Part, colours: Colours): string {
  const numbers: Record<Part, number> = { absolute: 0, relative: 1, tangential: 1, normal: 2, slip: 3, coriolis: 4 };
  return part === "absolute" ? colours.named.ink : colours.body(numbers[part]);
}

/** The sides that are drawn: from a pin on ground, the relative velocity is that of the pole. */
export function drawnSides(sides: readonly Side[]): Side[] {
  const longest = Math.max(0, ...sides.map(({ vector }) => size(vector)).filter(Number.isFinite));
  return sides.filter(
    ({ name, part, vector }) => size(vector) > NOTHING * longest && !(part === "relative" && name.endsWith(POLE)),
  );
}

/** A polygon with the letters of its images and the scale. */
export function paintPolygon(
  context: CanvasRenderingContext2D,
  polygon: Polygon,
  { kind, unit: base, units }: { kind: "velocities" | "accelerations"; unit: string; units: Units },
  [width, height]: Point,
  colours: Colours,
): void {
  const sides = drawnSides(polygon.sides);
  const ends = sides.flatMap(({ start, vector }) => [start, plus(start, vector)]);
  const view = around([[0, 0], ...ends], [width, height], 0.08);
  for (const { part, start, vector } of sides) {
    const [from, to] = [view.toScreen(start), view.toScreen(plus(start, vector))];
    paintArrow(context, from, to, colourOfPart(part, colours), part === "absolute" ? 2 : 1.6);
  }
  context.font = font(12, 600);
  context.textBaseline = "middle";
  context.textAlign = "center";
  const middle = view.toScreen(view.center);
  const taken: Box[] = [];
  for (const [at, names] of lettered(polygon, kind === "accelerations" ? "′" : "")) {
    const place = view.toScreen(at);
    const word = names.join(", ");
    const beside = freePlace(place, minus(place, middle), context.measureText(word).width / 2, taken);
    context.fillStyle = colours.named.ink;
    context.fill(circle(place, 2.5));
    rimmed(context, word, beside, colours.named.ink, colours.named.panel);
  }
  context.font = font(12);
  context.textAlign = "left";
  [...new Set(sides.map(({ part }) => part))].forEach((part, k) =>
    rimmed(context, texts.read.parts[part], [8, 12 + 16 * k], colourOfPart(part, colours), colours.named.panel),
  );
  const { factor, unit } = displayed(base, units);
  paintScale(context, view, { kind, unit: readable(unit), pixels: view.scale / factor }, width - 16, colours);
}

/** The middle of a text beside a place, away from the middle of the picture and free of other texts if possible. */
function freePlace(place: Point, away: Point, half: number, taken: Box[]): Point {
  const heading = Math.atan2(away[1], away[0]);
  const boxes = [0, 0.8, -0.8, 1.6, -1.6, 2.4, -2.4, 3.1].map((turn): Box => {
    const [dx, dy] = [Math.cos(heading + turn), Math.sin(heading + turn)];
    const [x, y] = [place[0] + dx * (half + GAP - 6), place[1] + dy * GAP];
    return [x - half, y - 7, x + half, y + 7];
  });
  const isFree = (a: Box) => taken.every((b) => a[2] < b[0] || b[2] < a[0] || a[3] < b[1] || b[3] < a[1]);
  const box = boxes.find(isFree) ?? boxes[0]!;
  taken.push(box);
  return [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2];
}

/** The names of the images at each place: small letters, with a prime for accelerations. */
function lettered({ images }: Polygon, prime: string): [Point, string[]][] {
  const found: [Point, string[]][] = [];
  const longest = Math.max(0, ...[...images.values()].map(size).filter(Number.isFinite));
  for (const [name, at] of images) {
    if (!Number.isFinite(at[0])) continue;
    const word = (name.length <= 2 ? name.toLowerCase() : name) + prime;
    const near = found.find(([other]) => size(minus(other, at)) <= NOTHING * longest);
    if (!near) found.push([at, [word]]);
    else if (!near[1].includes(word)) near[1].push(word);
  }
  return found;
}

/** A body alone with all forces on it, and d'Alembert's force. */
export function paintFreeBody(
  context: CanvasRenderingContext2D,
  found: FreeBody,
  of: { number: number; name: string; points: Point[]; items: readonly Item[]; poses: readonly Placement[] },
  [width, height]: Point,
  colours: Colours,
  named: (load: string) => string,
): void {
  const places = [...of.points.map((s) => placed(of.poses[of.number]!, s)), ...found.loads.map(({ place }) => place)];
  const view = around([...places, found.centre], [width, height], ROOM);
  const own = of.items.filter((item) => item.of === of.name && item.kind !== "text" && !item.numbered);
  context.save();
  context.globalAlpha = 0.55;
  paintItems(context, view, own, of.poses, { names: false, numbers: false }, colours);
  context.restore();
  const arrows = [
    ...found.loads.map(({ name, kind, place, force }) => ({ name: named(name), kind, place, force })),
    { name: "−m a", kind: "inertia" as const, place: found.centre, force: times(-1, found.force) },
  ];
  const most = Math.max(0, ...arrows.map(({ force }) => size(force)));
  const pixels = most > 0 ? LONGEST / most : 0;
  const vectors = (kind: Vectors["kind"], kinds: string[]): Vectors => ({
    kind,
    unit: "N",
    pixels,
    scaled: kind === "reactions",
    vectors: arrows
      .filter((one) => kinds.includes(one.kind) && size(one.force) > NOTHING * most)
      .map(({ name, place, force }) => {
        // a force that pushes on the body ends at its point
        const inwards = force[0] * (found.centre[0] - place[0]) + force[1] * (found.centre[1] - place[1]) > 0;
        const at = inwards ? minus(place, times(pixels / view.scale, force)) : place;
        return { element: name, owner: `(${name})`, at, value: force };
      }),
  });
  const all = [
    vectors("reactions", ["joint"]),
    vectors("force", ["driver", "force"]),
    vectors("velocities", ["gravity"]),
    vectors("accelerations", ["inertia"]),
  ];
  context.fillStyle = colours.named.ink;
  context.fill(circle(view.toScreen(found.centre), 3));
  const moments = [...found.loads, { name: "−J α", place: found.centre, moment: -found.moment }];
  const turning = Math.max(0, ...moments.map(({ moment }) => Math.abs(moment)));
  const reach = Math.max(0, ...places.map((at) => size(minus(at, found.centre))));
  for (const { name, place, moment } of moments) {
    if (Math.abs(moment) <= Math.max(NOTHING * turning, NOTHING * most * reach)) continue;
    paintMoment(
      context,
      view.toScreen(place),
      moment,
      `${quantity(Math.abs(moment), "N·m")} (${named(name)})`,
      colours,
    );
  }
  paintArrows(context, view, all, [], colours);
}

/** A moment: an arc with a head, counter-clockwise if it is positive. */
function paintMoment(
  context: CanvasRenderingContext2D,
  [x, y]: Point,
  moment: number,
  text: string,
  colours: Colours,
): void {
  const sign = moment > 0 ? 1 : -1;
  const at = (angle: number): Point => [x + sign * RADIUS * Math.cos(angle), y - RADIUS * Math.sin(angle)];
  const [begin, end, tip] = [at(-1), at(3.1), at(3.5)];
  context.strokeStyle = colours.named.drive;
  context.lineWidth = 2;
  context.stroke(new Line(`M${begin.join(" ")}A${RADIUS} ${RADIUS} 0 1 ${sign > 0 ? 0 : 1} ${end.join(" ")}`));
  paintArrow(context, end, tip, colours.named.drive, 2);
  context.font = font(12);
  context.textAlign = "center";
  context.textBaseline = "middle";
  rimmed(context, text, [x, y - RADIUS - 10], colours.named.drive, colours.named.panel);
}

/** The name of a centre by the numbers of its bodies, such as P12. */
export function nameOf({ i, j }: Centre, bodies: number): string {
  return `P${i}${bodies > 10 ? "," : ""}${j}`;
}

/** The centres with their names on the sheet, one text for the centres at a place. */
export function paintCentres(
  context: CanvasRenderingContext2D,
  view: View,
  centres: readonly Centre[],
  bodies: number,
  colours: Colours,
): void {
  const found: [Point, string[]][] = [];
  for (const one of centres) {
    if (!one.at) continue;
    const at = view.toScreen(one.at);
    if (!(at[0] >= 0 && at[0] <= view.width && at[1] >= 0 && at[1] <= view.height)) continue;
    const near = found.find(([other]) => size(minus(other, at)) < 3);
    if (near) near[1].push(nameOf(one, bodies));
    else found.push([at, [nameOf(one, bodies)]]);
  }
  context.font = font(12, 600);
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const [at, names] of found) {
    context.fillStyle = colours.named.panel;
    context.strokeStyle = colours.named.reactions;
    context.lineWidth = 2;
    context.fill(circle(at, 4));
    context.stroke(circle(at, 4));
    rimmed(context, names.join(", "), [at[0] + 9, at[1] - 10], colours.named.reactions, colours.named.panel);
  }
}

/** The fixed and the moving centrode of a pair, which touch at the centre. */
export function paintCentrodes(
  context: CanvasRenderingContext2D,
  view: View,
  { pair, lines }: Centrodes,
  poses: readonly Placement[],
  colours: Colours,
): void {
  context.lineWidth = 1.8;
  lines.forEach((line, k) => {
    const pose = poses[pair[k]!];
    if (!pose) return;
    // a line that leaves the picture far behind is broken there
    const far = 20 * Math.max(view.width, view.height);
    const places = line.map((at) => at && view.toScreen(placed(pose, at)));
    const kept = places.map((at) => (at && Math.abs(at[0]) < far && Math.abs(at[1]) < far ? at : null));
    context.strokeStyle = colours.body(pair[k]!);
    context.setLineDash(k ? [6, 4] : []);
    context.stroke(broken(kept));
  });
  context.setLineDash([]);
}
