// Changes of the text that remove and rename entries, and everything that refers to them.
import { GROUPS, type Group } from "../catalogue/catalogue";
import { entries, isTable, mentions } from "../catalogue/tree";
import type { Change, Path, Tree, Value } from "../core/protocol";

/** Remove an entry and the elements that need it. */
export function removed(tree: Tree | null, group: Group, name: string): Change[] {
  const gone = new Map<string, Group>([[name, group]]);
  for (let before = -1; before !== gone.size; ) {
    before = gone.size;
    for (const other of GROUPS.slice(1)) {
      for (const [key, value] of Object.entries(entries(tree, other))) {
        if (!gone.has(key) && refersToAny(value, gone.keys())) gone.set(key, other);
      }
    }
  }
  const changes = [...gone].reverse().map(([key, of]): Change => ({ path: [of, key], remove: true }));
  return [...changes, ...orphans(tree, [...gone.keys()])];
}

function refersToAny(value: Value, names: Iterable<string>): boolean {
  for (const name of names) if (mentions(value, name)) return true;
  return false;
}

/** Values of the start that concern removed entries. */
function orphans(tree: Tree | null, names: string[]): Change[] {
  const start = tree?.start;
  if (!isTable(start)) return [];
  return ["set", "guess"].flatMap((part) => {
    const table = start[part];
    if (!isTable(table)) return [];
    const keys = Object.keys(table).filter((key) => names.includes(key.split(".")[0]!));
    return keys.map((key): Change => ({ path: ["start", part, key], remove: true }));
  });
}

/** Remove a point of a body and everything that refers to it. */
export function removedPoint(tree: Tree | null, body: string, point: string): Change[] {
  const reference = `${body}.${point}`;
  const gone = GROUPS.slice(1).flatMap((group) =>
    Object.entries(entries(tree, group))
      .filter(([, value]) => Object.values(value).some((one) => one === reference))
      .flatMap(([name]) => removed(tree, group, name)),
  );
  const found = entries(tree, "bodies")[body];
  const tables = ["points", "through"].filter((part) => isTable(found?.[part]) && point in (found[part] as Tree));
  const own = tables.map((part): Change => ({ path: ["bodies", body, part, point], remove: true }));
  return [...distinct(gone), ...own];
}

function distinct(changes: Change[]): Change[] {
  return [...new Map(changes.map((one) => [one.path.join("\0"), one])).values()];
}

/** Give an entry another name, there and wherever it is mentioned. */
export function renamed(tree: Tree | null, group: string, name: string, next: string): Change[] {
  const changes: Change[] = [];
  const word = new RegExp(`(?<![\\p{L}\\p{N}_.])${literal(name)}(?![\\p{L}\\p{N}_])`, "gu");
  const replaced = (value: Value): Value => {
    if (Array.isArray(value)) return value.map(replaced);
    return typeof value === "string" ? value.replace(word, next) : value;
  };
  visit(tree ?? {}, [], (path, value) => {
    if (path[0] === "title" || path[0] === "parameters") return;
    const after = replaced(value);
    if (path.at(-1) !== "type" && JSON.stringify(after) !== JSON.stringify(value)) changes.push({ path, value: after });
  });
  for (const part of ["set", "guess"]) {
    const table = isTable(tree?.start) ? tree.start[part] : undefined;
    for (const key of isTable(table) ? Object.keys(table) : []) {
      if (key.split(".")[0] === name)
        changes.push({ path: ["start", part, key], rename: next + key.slice(name.length) });
    }
  }
  return [...changes, { path: [group, name], rename: next }];
}

function literal(text: string): string {
  return text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
}

/** Every value that is not a table; a list is one value. */
function visit(value: Value, path: Path, call: (path: Path, value: Value) => void): void {
  if (isTable(value)) for (const [key, one] of Object.entries(value)) visit(one, [...path, key], call);
  else call(path, value);
}
