// The text of the case and its history. Each change, by keyboard or mouse, changes the text.
import { signal } from "@preact/signals";
import type { Change } from "../core/protocol";
import { texts } from "../texts";
import { MOST_OF_TEXT } from "./limits";
import { edited, load, reason, report, Superseded } from "./session";
import { fitNext } from "./sheet";
import { announce, held, message, openings, selection, text } from "./state";

/** The file of a case: its name, and where the browser may write it again. */
export interface CaseFile {
  name: string;
  handle?: FileSystemFileHandle;
}

/** A text of the history. Another opening is another case. */
export interface Step {
  text: string;
  file: CaseFile;
  opening: number;
}

/** Texts kept for undoing; a text is at most 2 MB. */
const MOST = 200;
/** The letters of all texts for undoing. */
const MOST_LETTERS = 2e7;
/** Changes typed within this time are one step of the history, ms. */
const PAUSE = 900;

export const past = signal<Step[]>([]);
export const future = signal<Step[]>([]);
export const file = signal<CaseFile>({ name: "mechanism.toml" });
/** The last text that was typed, and when. */
let typed = { text: "", at: 0 };

function present(given = text.value): Step {
  return { text: given, file: file.value, opening: openings.value };
}

/** Begin with another case, whose view and selection are its own. */
function begin(opening: number, of: CaseFile): void {
  openings.value = opening;
  file.value = of;
  selection.value = null;
  held.value = new Set();
  fitNext();
}

/**
 * Open another text; undo brings the present one back. Returns the reason if the core could not read it, otherwise
 * null.
 */
export async function open(given: string, of: CaseFile = { name: "mechanism.toml" }): Promise<string | null> {
  if (isTooLarge(given)) return texts.core.tooLarge;
  if (text.value && text.value !== given) remember(text.value);
  begin(openings.value + 1, of);
  message.value = null;
  text.value = given;
  try {
    await load(given);
    return null;
  } catch (error) {
    report(error);
    return reason(error);
  }
}

/** Whether a text is so large that the page would become slow; a message is shown then. */
function isTooLarge(given: string): boolean {
  const found = given.length > MOST_OF_TEXT;
  if (found) announce("problem", texts.core.tooLarge);
  return found;
}

/** Replace the text. With `record`, this is a step of the history, after the text `before`. */
export async function take(given: string, record = true, before = text.value): Promise<void> {
  if (isTooLarge(given)) return;
  if (record && given !== before) remember(before);
  text.value = given;
  try {
    await load(given);
  } catch (error) {
    if (!(error instanceof Superseded)) report(error);
  }
}

/** Replace the text while the user types. Quick changes without others between them are one step of the history. */
export async function type(given: string): Promise<void> {
  const now = Date.now();
  const record = now - typed.at > PAUSE || text.value !== typed.text || future.value.length > 0;
  typed = { text: given, at: now };
  await take(given, record);
}

function remember(before: string): void {
  const steps = [...past.value.slice(1 - MOST), present(before)];
  let size = 0;
  let first = steps.length;
  while (first > 0 && size < MOST_LETTERS) {
    first -= 1;
    size += steps[first]!.text.length;
  }
  past.value = steps.slice(first);
  future.value = [];
}

/** The work of earlier changes. Each change is made to the text with those before. */
let changing: Promise<boolean> = Promise.resolve(true);

/** Change the text through the core, as one step of the history; returns whether it succeeded. */
export function change(changes: Change[]): Promise<boolean> {
  changing = changing.then(() => changeNow(changes));
  return changing;
}

async function changeNow(changes: Change[]): Promise<boolean> {
  if (!changes.length) return false;
  message.value = null;
  try {
    await take(await edited(changes));
    return true;
  } catch (error) {
    report(error);
    return false;
  }
}

/** A continuous change, such as a drag. Only its end is a step of the history. */
export class Draft {
  private readonly before = text.value;
  private latest: Change[] | null = null;
  private working: Promise<void> | null = null;

  /** Show these changes. Of changes that arrive while the core is busy, only the newest are applied. */
  show(changes: Change[]): void {
    this.latest = changes;
    this.working ??= this.work();
  }

  /** Show these changes, and wait until they are drawn. */
  async apply(changes: Change[]): Promise<void> {
    this.show(changes);
    await this.working;
  }

  private async work(): Promise<void> {
    while (this.latest) {
      const changes = this.latest;
      this.latest = null;
      try {
        await take(await edited(changes), false);
      } catch (error) {
        report(error);
      }
    }
    this.working = null;
  }

  /** End with the shown text. */
  async keep(): Promise<void> {
    await this.working;
    if (text.value !== this.before) remember(this.before);
  }

  /** End with the text before the change. */
  async drop(): Promise<void> {
    this.latest = null;
    await this.working;
    if (text.value !== this.before) await take(this.before, false);
  }
}

/** Go to the last step of one list; the present text becomes a step of the other. */
async function go(from: typeof past, to: typeof past): Promise<void> {
  const next = from.value.at(-1);
  if (!next) return;
  from.value = from.value.slice(0, -1);
  to.value = [...to.value, present()];
  if (next.opening !== openings.value) begin(next.opening, next.file);
  await take(next.text, false);
}

export const undo = () => go(past, future);
export const redo = () => go(future, past);
