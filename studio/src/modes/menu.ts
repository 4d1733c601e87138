// The menu of a thing on the sheet: what is possible with it, and why the rest is not.
import { isPin, typeOf } from "../catalogue/catalogue";
import { entries, entry } from "../catalogue/tree";
import { GROUND, pinTo, pointReference } from "../edit/adding";
import { canPaste, copy, pasteCopied, remove, swap, takeCopy } from "../edit/commands";
import { ofPoint } from "../edit/holding";
import { hasSides } from "../edit/swapping";
import { change } from "../store/document";
import { type Entry, menu } from "../store/menu";
import { report } from "../store/session";
import { fit } from "../store/sheet";
import { catalogue, held, mechanism, mode, panel, poses, selection, tools, tree } from "../store/state";
import { texts } from "../texts";
import { coordinateOf } from "./coordinate";
import { edit } from "./edit";
import type { Spot } from "./handler";
import { enter } from "./modes";
import { driveBy, restart } from "./place";
import { ownerUnder, under } from "./refer";

/** Open the menu at a place. */
export async function openMenu(spot: Spot): Promise<void> {
  menu.value = null;
  if (mode.value !== "edit") enter("edit");
  restart(null);
  edit.click?.(spot);
  const chosen = selection.value;
  const title = chosen ? [chosen.name, chosen.point].filter(Boolean).join(".") : texts.atPlace.sheet;
  menu.value = { at: spot.px, title, entries: chosen ? await ofThing(spot) : ofSheet(spot) };
}

function ofSheet(spot: Spot): Entry[] {
  return [
    { label: texts.atPlace.groundPoint, run: () => addPoint(spot) },
    canPaste()
      ? { label: texts.atPlace.paste, run: pasteCopied }
      : { label: texts.atPlace.paste, why: texts.atPlace.nothing },
    { label: texts.sheet.fitHint, run: fit },
  ];
}

async function ofThing(spot: Spot): Promise<Entry[]> {
  const { group, name, point } = selection.value!;
  const words = texts.atPlace;
  const body = group === "bodies";
  const isGround = body && name === GROUND;
  const type = typeOf(catalogue.value, group, name, entry(tree.value, group, name));
  const found = under(spot, new Set());
  const owner = ownerUnder(found);
  const motion = await coordinateOf(owner, false);
  const sides = type && hasSides(type);
  return [
    { label: words.properties, run: () => (panel.value = "properties") },
    motion
      ? { label: words.drive, run: () => void driveBy(tools.value, motion).catch(report) }
      : { label: words.drive, why: owner ? texts.place.held(owner) : words.fixed },
    pinEntry(found),
    ...(body
      ? [
          { label: words.pointHere, run: () => addPoint(spot) },
          isGround
            ? { label: texts.properties.copy, why: words.one }
            : { label: texts.properties.copy, run: () => void copy(name) },
          isGround ? { label: words.copy, why: words.one } : { label: words.copy, run: () => takeCopy(name) },
        ]
      : []),
    ...(point ? [{ label: words.keep, run: () => keepPoint(ofPoint(name, point)) }] : []),
    ...(sides ? [{ label: texts.place.swap, run: () => void swap(group, name) }] : []),
    isGround && !point
      ? { label: texts.properties.remove, why: words.ground }
      : { label: texts.properties.remove, run: () => void remove() },
  ];
}

/** Pin the bodies that have points at this place. */
function pinEntry({ hits }: ReturnType<typeof under>): Entry {
  const label = texts.atPlace.pin;
  const [first, second] = hits;
  if (!first || !second) return { label, why: texts.atPlace.alone };
  const pins = new Set(catalogue.value.joints.filter(isPin).map((one) => one.name));
  const names = hits.map(({ body, point }) => `${body.name}.${point}`);
  const pinned = Object.values(entries(tree.value, "joints")).some(
    ({ type, i, j }) => pins.has(String(type)) && names.includes(String(i)) && names.includes(String(j)),
  );
  if (pinned) return { label, why: texts.atPlace.pinned };
  const changes = pinTo({ hits: [first] }, second.body.name, second.point, catalogue.value, tree.value, new Set());
  return { label, run: () => void change(changes) };
}

function addPoint(spot: Spot): void {
  const { body } = under(spot, new Set());
  const all = { tree: tree.value, bodies: mechanism.value?.bodies ?? [], poses: poses.value };
  const added = pointReference({ at: spot.at, hits: [] }, body, all, []);
  void change(added.changes);
}

function keepPoint(key: string): void {
  const next = new Set(held.value);
  if (!next.delete(key)) next.add(key);
  held.value = next;
}
