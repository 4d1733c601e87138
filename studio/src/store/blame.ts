// The parts of the drawing that a fault names, and its sentence without names and numbers of equations.
import { computed } from "@preact/signals";
import { GROUPS, type Group } from "../catalogue/catalogue";
import { entries } from "../catalogue/tree";
import { texts } from "../texts";
import { message, problems, tree, unassembled } from "./state";

export interface Part {
  group: Group;
  name: string;
}

/** A fault of a position in plain words; other messages of the core stay as they are. */
export function plainly(text: string): string {
  const [, time, names] = /^singular position at (t = \S+ s)?.*?(?:\(joints? ([^;)]*))?[;)]/s.exec(text) ?? [];
  if (!text.startsWith("singular position")) return text;
  return names ? texts.read.singular(time ?? "", names) : texts.read.undetermined;
}

/** The elements that a path or a sentence names, bodies last. */
function partsIn(path: string | null | undefined, text: string): Part[] {
  const [group, name] = (path ?? "").split(".");
  const own = GROUPS.find((one) => one === group);
  const found: Part[] = own && name && entries(tree.value, own)[name] ? [{ group: own, name }] : [];
  const words = new Set(text.match(/[\p{L}_][\p{L}\p{N}_]*/gu));
  for (const other of [...GROUPS].reverse()) {
    // a single letter may be a point; joints of this name are meant by sentences about joints
    for (const one of Object.keys(entries(tree.value, other)))
      if (words.has(one) && one !== "ground" && !found.some((part) => part.name === one))
        found.push({ group: other, name: one });
  }
  return found;
}

/** The parts that the shown fault names. */
export const blamed = computed<Part[]>(() => {
  const fault = problems.value[0] ?? unassembled.value;
  if (fault) return partsIn(fault.path, fault.message);
  return message.value?.kind === "problem" ? partsIn(null, message.value.text) : [];
});
