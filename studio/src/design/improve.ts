// Improve: the core searches the values of ticked parameters that make a number best; each run is a request of its own.
import { computed, effect, signal } from "@preact/signals";
import { isTable } from "../catalogue/tree";
import type { Body, Change, Parameter, Search, Tree, Value } from "../core/protocol";
import { CoreError } from "../core/transport";
import type { Placement } from "../plane/points";
import { change, undo } from "../store/document";
import { report, send } from "../store/session";
import { loads, mechanism, openings, poses, text, tree } from "../store/state";
import { texts } from "../texts";

export const AIMS = ["minimize", "maximize", "target"] as const;
export type Aim = (typeof AIMS)[number];

/** The number that is improved, and whose slopes are shown. */
export const measure = signal("");
export const aim = signal<Aim>("minimize");
/** The value of a target, as typed. */
export const wanted = signal("");
/** Limits, one a line. */
export const limits = signal("");
/** Bounds of the parameters that may change, in SI units; a third entry is the scale. */
export const bounds = signal<Record<string, Value[]>>({});
export const busy = signal(false);
export const fault = signal("");
/** The last search, while its numbers are those of the text or it goes on. */
export const found = signal<Search | null>(null);
/** The mechanism before the search, for comparison. */
export const before = signal<{ bodies: Body[]; poses: readonly Placement[]; parameters: Parameter[] } | null>(null);

/** The section, as it is written. */
const section = computed<Tree>(() => (isTable(tree.value?.optimize) ? tree.value.optimize : {}));
/** A search from the present values has no other starts. */
export const starts = computed(() => Number(section.value.starts ?? 1));
let read = "";
/** The text with the numbers of the search. */
let improved: string | null = null;
/** Whether the search has changed the text. */
let moved = false;

effect(() => {
  openings.value;
  [measure, wanted, limits, fault].forEach((one) => {
    one.value = "";
  });
  [bounds.value, found.value, before.value, read, improved] = [{}, null, null, "", null];
});

// what is written in the case fills the fields, when it is opened and when it changes
effect(() => {
  loads.value;
  const own = section.value;
  const now = JSON.stringify(own);
  if (now !== read && isTable(own.variables)) {
    const key = AIMS.find((one) => own[one] !== undefined) ?? "minimize";
    const value = own[key];
    const [first] = key === "target" && isTable(value) ? Object.entries(value) : [];
    aim.value = key;
    measure.value = String(first ? first[0] : typeof value === "string" ? value : "");
    wanted.value = String(first?.[1] ?? "");
    limits.value = [own.subject_to ?? []].flat().join("\n");
    bounds.value = own.variables as Record<string, Value[]>;
  }
  read = now;
  if (improved !== null && text.peek() !== improved) dismiss();
});

/** Forget the comparison. */
export function dismiss(): void {
  [found.value, before.value, improved] = [null, null, null];
}

/** The changes that write the section. */
function asked(): Change[] {
  const own = section.value;
  const lines = limits.value.split("\n").flatMap((line) => line.trim() || []);
  const key = measure.value.trim();
  const value = aim.value === "target" ? { [key]: Number(wanted.value.replace(",", ".")) } : key;
  const pairs: [string, Value | undefined][] = [
    ["variables", bounds.value],
    ...AIMS.map((one): [string, Value | undefined] => [one, one === aim.value ? value : undefined]),
    ["subject_to", lines.length ? lines : undefined],
  ];
  return pairs.flatMap(([name, to]): Change[] => {
    if (JSON.stringify(own[name]) === JSON.stringify(to)) return [];
    const path = ["optimize", name];
    return to === undefined ? [{ path, remove: true }] : [{ path, value: to }];
  });
}

/** Search until nothing is gained or the search is cancelled, and write the best numbers into the text. */
export async function improve(): Promise<void> {
  if (busy.value) return;
  dismiss();
  const words = texts.improve;
  const lacks = !measure.value.trim()
    ? words.noNumber
    : !Object.keys(bounds.value).length
      ? words.noVariable
      : aim.value === "target" && !Number.isFinite(Number.parseFloat(wanted.value.replace(",", ".")))
        ? words.noTarget
        : "";
  fault.value = lacks;
  if (lacks || !(await written())) return;
  busy.value = true;
  const of = loads.value;
  const { bodies, parameters } = mechanism.value!;
  before.value = { bodies, parameters, poses: poses.value };
  try {
    found.value = (await send("optimize", {})).ok;
    while (busy.value && !found.value.ending && loads.value === of) found.value = (await send("improve", {})).ok;
  } catch (error) {
    if (!(error instanceof CoreError)) report(error);
    else if (loads.value === of) {
      const { message, hint } = error.problem;
      fault.value = hint ? `${message}; ${hint}` : message;
    }
  }
  busy.value = false;
  const last: Search | null = found.value;
  if (loads.value !== of) fault.value = texts.improve.changed;
  const given = text.value;
  const pairs = Object.entries(last?.values ?? {});
  const changes = pairs.map(([name, to]) => ({ path: ["parameters", name], value: rewritten(name, to, 17) }));
  if (fault.value || !(await change(changes))) return dismiss();
  [improved, moved] = [text.value, text.value !== given];
}

/** The value of a parameter as it is written: a number in SI units, or with the unit that the text has. */
export function rewritten(name: string, value: number, digits: number): string | number {
  const written = (tree.value?.parameters as Tree | undefined)?.[name];
  const text = typeof written === "string" ? written : "";
  const unit = /^\s*[-+]?[\d.]+(?:e[-+]?\d+)?\s*([^\d\s*/+-].*)$/i.exec(text)?.[1];
  const rounded = (x: number) => Number(x.toPrecision(digits));
  const factor = mechanism.value?.parameters.find((one) => one.name === name)?.value;
  const number = Number.parseFloat(text);
  return unit && factor && number ? `${rounded((value * number) / factor)} ${unit}` : rounded(value);
}

/** Write the section; false if the core does not accept it. */
async function written(): Promise<boolean> {
  const changes = asked();
  return changes.length ? change(changes) : true;
}

export function cancel(): void {
  busy.value = false;
}

export async function discard(): Promise<void> {
  dismiss();
  if (moved) await undo();
}
