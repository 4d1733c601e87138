// Reads the tree of a case.
import type { Tree, Value } from "../core/protocol";
import { GROUPS, type Group } from "./catalogue";

/** The entries of a group by name. */
export function entries(tree: Tree | null, group: string): Record<string, Tree> {
  const found = tree?.[group];
  return isTable(found) ? (found as Record<string, Tree>) : {};
}

export function entry(tree: Tree | null, group: string, name: string): Tree | undefined {
  const found = entries(tree, group)[name];
  return isTable(found) ? found : undefined;
}

export function isTable(value: Value | undefined): value is Tree {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** The group in which a name is defined. */
export function groupOf(tree: Tree | null, name: string): Group | undefined {
  return GROUPS.find((group) => entry(tree, group, name));
}

/** Whether a text anywhere in a value contains a name as a word. */
export function mentions(value: Value | undefined, name: string): boolean {
  if (typeof value === "string") return words(value).includes(name);
  if (Array.isArray(value)) return value.some((one) => mentions(one, name));
  return isTable(value) && Object.entries(value).some(([key, one]) => words(key).includes(name) || mentions(one, name));
}

/** The first words of dotted names in a text: "crank" of "crank.angle". */
function words(text: string): string[] {
  return [...text.matchAll(/(?<![\p{L}\p{N}_.])[\p{L}_][\p{L}\p{M}\p{N}_]*/gu)].map(([word]) => word);
}

/** A name that no entry has: the stem and the least free number. */
export function freeName(tree: Tree | null, stem: string, more: Iterable<string> = []): string {
  const taken = new Set([...GROUPS, "measures", "parameters"].flatMap((group) => Object.keys(entries(tree, group))));
  for (const name of more) taken.add(name);
  for (let k = 1; ; k += 1) if (!taken.has(`${stem}${k}`)) return `${stem}${k}`;
}

const LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZ";

/** Names of points that no body and no element has: A, B, … Z, A2, B2 … */
export function freePointNames(tree: Tree | null, taken: Iterable<string>, count: number): string[] {
  const used = new Set(taken);
  for (const group of GROUPS) for (const name of Object.keys(entries(tree, group))) used.add(name);
  const found: string[] = [];
  for (let k = 0; found.length < count; k += 1) {
    const round = Math.floor(k / LETTERS.length);
    const name = LETTERS[k % LETTERS.length]! + (round ? String(round + 1) : "");
    if (!used.has(name)) found.push(name);
  }
  return found;
}
