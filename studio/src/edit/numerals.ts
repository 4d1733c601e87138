// The numbers of the text that determine the place of a point: literals, and those of parameters in formulas.
import { entries, entry, isTable } from "../catalogue/tree";
import type { Change, Path, Tree, Value } from "../core/protocol";
import type { PointHit } from "../plane/hits";
import { ofAngle, ofLengths } from "./holding";
import { prescribed } from "./start";

/** A number in a value of the case. */
export interface Numeral {
  /** The name by which people know it: a parameter, or a field of a body. */
  label: string;
  path: Path;
  /** Its place in a list; null in a single value. */
  index: number | null;
  /** Its letters in a formula; equal for a plain number. */
  from: number;
  to: number;
  value: number;
  /** Numbers with a lower rank are tried first. */
  rank: number;
  /** What keeps this number while drawing, by the names in holding.ts. */
  kept?: string;
}

/** A number of a formula, with its sign at the start, not in a name or an exponent. */
const NUMBER = /(?:^\s*[-+]?|(?<![\w.^]))(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?(?![\w.])/gi;
const WORD = /(?<![\w.])[A-Za-z_]\w*/g;

/** The ranks of lengths and coordinates, of the start, of zeros, and of numbers beside a parameter. */
const [SHAPE, START, ZERO, BESIDE, GUESS] = [0, 1, 3, 4, 6];

/** The numbers that may determine points at one place, the most natural ones first. */
export function numeralsAt(tree: Tree | null, hits: readonly PointHit[]): Numeral[] {
  const found = hits.flatMap((hit) => [
    ...ofShape(tree, hit).map((one) => ({ ...one, kept: ofLengths(hit.body.name) })),
    ...ofStart(tree, hit.body.name).map((one) => ({ ...one, kept: ofAngle(hit.body.name) })),
  ]);
  const own = [...new Map(found.map((one) => [keyOf(one), one])).values()];
  return own.sort((a, b) => a.rank - b.rank);
}

export function keyOf({ path, index, from }: Numeral): string {
  return [...path, index, from].join("\0");
}

function ofShape(tree: Tree | null, { body, point }: PointHit): Numeral[] {
  const found = entry(tree, "bodies", body.name);
  const base = ["bodies", body.name];
  const pairs = ["through", "points"].flatMap((part): [Path, string, Value][] => {
    const at = isTable(found?.[part]) ? (found[part] as Tree)[point] : undefined;
    return at === undefined ? [] : [[[...base, part, point], `${body.name}.${point}`, at]];
  });
  if (found?.at !== undefined) pairs.push([[...base, "at"], body.name, found.at]);
  const coordinates = pairs.flatMap(([path, label, at]) =>
    Array.isArray(at)
      ? at.flatMap((one, k) => numeralsIn(tree, one, path, k, `${label}.${"xy"[k]}`, one === 0 ? ZERO : SHAPE))
      : [],
  );
  const length = found?.length;
  if (length === undefined) return coordinates;
  return [...coordinates, ...numeralsIn(tree, length, [...base, "length"], null, `${body.name}.length`, SHAPE)];
}

/** The values of the start, and laws of drivers, that place a body. */
function ofStart(tree: Tree | null, body: string): Numeral[] {
  const isOwn = (name: unknown) =>
    typeof name === "string" && /^(?:.*\.)?(?:angle|x|y)$/.test(name) && name.split(".")[0] === body;
  const set = (["set", "guess"] as const).flatMap((part) =>
    prescribed(tree, part)
      .filter(({ name }) => isOwn(name))
      .flatMap(({ name, value, path }) => numeralsIn(tree, value, path, null, name, part === "set" ? START : GUESS)),
  );
  const laws = Object.entries(entries(tree, "drivers")).filter(([, { coordinate }]) => isOwn(coordinate));
  return [
    ...set,
    ...laws.flatMap(([name, { value }]) =>
      numeralsIn(tree, value, ["drivers", name, "value"], null, String(name), START).map((one) => ({
        ...one,
        rank: Math.max(one.rank, START),
      })),
    ),
  ];
}

/** The numbers of a value; those of parameters in a formula come before its own. */
function numeralsIn(
  tree: Tree | null,
  value: Value | undefined,
  path: Path,
  index: number | null,
  label: string,
  rank: number,
  within: readonly string[] = [],
): Numeral[] {
  if (typeof value === "number") return [{ label, path, index, from: 0, to: 0, value, rank }];
  if (typeof value !== "string") return [];
  const parameters = entries(tree, "parameters") as unknown as Tree;
  const names = [...new Set([...value.matchAll(WORD)].map(([word]) => word))].filter(
    (word) => word in parameters && !within.includes(word),
  );
  const inner = names.flatMap((name) =>
    numeralsIn(tree, parameters[name], ["parameters", name], null, name, rank, [...within, name]),
  );
  const own = [...value.matchAll(NUMBER)].map((match): Numeral => {
    const from = match.index;
    const number = Number(match[0]);
    return { label, path, index, from, to: from + match[0].length, value: number, rank: names.length ? BESIDE : rank };
  });
  return [...inner, ...own];
}

/** The value at the path of a number, as it is written. */
export function writtenAt(tree: Tree | null, { path }: Numeral): Value {
  return path.reduce<Value>((at, key) => (isTable(at) ? (at[key] ?? null) : null), tree ?? {});
}

/** The changes that give numbers other values. Several of them may be in one formula. */
export function withValues(tree: Tree | null, numerals: readonly Numeral[], values: readonly number[]): Change[] {
  const found = new Map<string, { path: Path; value: Value }>();
  const order = numerals.map((_, k) => k).sort((a, b) => numerals[b]!.from - numerals[a]!.from);
  for (const k of order) {
    const one = numerals[k]!;
    const key = one.path.join("\0");
    const before = found.get(key)?.value ?? writtenAt(tree, one);
    found.set(key, { path: one.path, value: replaced(before, one, values[k]!) });
  }
  return [...found.values()];
}

function replaced(before: Value, { index, from, to }: Numeral, number: number): Value {
  if (index !== null && Array.isArray(before))
    return before.map((one, k) => (k === index ? replacedIn(one, from, to, number) : one));
  return replacedIn(before, from, to, number);
}

function replacedIn(before: Value, from: number, to: number, number: number): Value {
  if (typeof before !== "string") return number;
  const written = number < 0 && from > 0 ? `(${number})` : String(number);
  return before.slice(0, from) + written + before.slice(to);
}
