// The work of this tab: text, history, view and mode outlive a reload. The browser keeps them until the tab is closed.
import { effect } from "@preact/signals";
import { texts } from "../texts";
import { file, future, past, type Step } from "./document";
import { view, viewed, viewNext } from "./sheet";
import { announce, held, type Mode, mode, openings, text, units } from "./state";

/** A text as a change of another one: equal letters at the start and at the end, and those between. */
type Delta = [number, number, string];

interface Kept {
  /** The number of the tab; a duplicated tab has that of the other one. */
  tab: string;
  /** The link or the text with which the page began. */
  source: string;
  text: string;
  file: string;
  opening: number;
  past: { change: Delta; file: string; opening: number }[];
  future: Kept["past"];
  mode: Mode;
  view: Parameters<typeof viewNext>[0];
  units: typeof units.value;
  held: string[];
}

/** Pages of other addresses are other work. */
const KEY = `kempe.work ${location.pathname}`;
/** The history is stored up to this number of letters. */
const MOST = 500_000;
/** Work is stored at most so often, ms. */
const PAUSE = 200;

let tab = newTab();
let source = "";

function newTab(): string {
  return `${Date.now()} ${Math.random()}`;
}

const changes = new WeakMap<Step, { base: string; change: Delta }>();

function changeOf(step: Step, base: string): Delta {
  const known = changes.get(step);
  if (known?.base === base) return known.change;
  const { text: own } = step;
  const most = Math.min(own.length, base.length);
  let begin = 0;
  while (begin < most && own[begin] === base[begin]) begin += 1;
  let end = 0;
  while (end < most - begin && own[own.length - 1 - end] === base[base.length - 1 - end]) end += 1;
  const change: Delta = [begin, end, own.slice(begin, own.length - end)];
  changes.set(step, { base, change });
  return change;
}

/** The newest steps of a list, each as a change of the one after it, the last one of the present text. */
function packed(steps: Step[]): Kept["past"] {
  const found: Kept["past"] = [];
  let base = text.value;
  let size = 0;
  for (const step of [...steps].reverse()) {
    // texts that differ everywhere are not compared
    size += Math.abs(step.text.length - base.length);
    if (size > MOST) break;
    const change = changeOf(step, base);
    size += change[2].length;
    if (size > MOST) break;
    found.push({ change, file: step.file.name, opening: step.opening });
    base = step.text;
  }
  return found.reverse();
}

function unpacked(steps: Kept["past"], present: string): Step[] {
  let base = present;
  const found = [...steps].reverse().map(({ change: [begin, end, middle], file: name, opening }) => {
    base = base.slice(0, begin) + middle + base.slice(base.length - end);
    return { text: base, file: { name }, opening };
  });
  return found.reverse();
}

/** Store the work. If it is too much for the browser, the history is left out. */
function store(): void {
  if (!text.value) return;
  const { center, moved } = view;
  const zoom = view.scale / view.fitted();
  const kept: Kept = {
    tab,
    source,
    text: text.value,
    file: file.value.name,
    opening: openings.value,
    past: packed(past.value),
    future: packed(future.value),
    mode: mode.value,
    view: moved ? { center, zoom } : null,
    units: units.value,
    held: [...held.value],
  };
  for (const part of [kept, { ...kept, past: [], future: [] }]) {
    try {
      sessionStorage.setItem(KEY, JSON.stringify(part));
      return;
    } catch {
      // A browser may have no storage at all.
    }
  }
}

/** The page has begun with this link or text, or has opened another link. */
export function begunWith(given: string): void {
  source = given;
  store();
}

/** Keep the work from now on. */
export function keep(): void {
  let waits = false;
  effect(() => {
    for (const one of [text, past, future, file, mode, viewed, units, held]) one.value;
    if (waits) return;
    waits = true;
    setTimeout(() => {
      waits = false;
      store();
    }, PAUSE);
  });
  addEventListener("pagehide", store);
}

/** What was kept in this tab, or null. Its history, units and view are taken up; the caller opens its text and mode. */
export function restored(): Pick<Kept, "source" | "text" | "mode"> | null {
  try {
    const kept = JSON.parse(sessionStorage.getItem(KEY) ?? "null") as Kept | null;
    if (!kept) return null;
    const steps = [unpacked(kept.past, kept.text), unpacked(kept.future, kept.text)] as const;
    [past.value, future.value] = steps;
    [openings.value, file.value, units.value] = [kept.opening, { name: kept.file }, kept.units];
    held.value = new Set(kept.held);
    viewNext(kept.view);
    tab = kept.tab;
    return kept;
  } catch {
    return null;
  }
}

/** The place in the storage of all tabs where one tab calls the others; a page from a disk has no channel for it. */
const CALLS = "kempe.tabs";
/** A busy tab answers a call within this time, ms. */
const ANSWERS = 10_000;

/** A tab with the work of another open tab is a copy of it, with a file of its own. */
export function tellApart(copied: boolean): void {
  let asks = copied;
  const call = (what: "asks" | "taken") => {
    try {
      localStorage.setItem(CALLS, `${what} ${tab} ${Math.random()}`);
    } catch {
      // Without a storage there is no work of another tab either.
    }
  };
  addEventListener("storage", ({ key, newValue }) => {
    const said = (what: string) => key === CALLS && newValue?.startsWith(`${what} ${tab} `);
    if (said("taken") && asks) {
      asks = false;
      tab = newTab();
      file.value = { name: file.value.name.replace(/( copy)?(\.toml)?$/, " copy.toml") };
      announce("info", texts.files.copied(file.value.name));
    } else if (said("asks")) call("taken");
  });
  if (copied) call("asks");
  setTimeout(() => (asks = false), ANSWERS);
}
