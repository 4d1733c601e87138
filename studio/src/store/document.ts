// The text of the case with its history: every change, by hand or by mouse, is a change of the text.
import { signal } from "@preact/signals";
import type { Change } from "../core/protocol";
import { texts } from "../texts";
import { MOST_OF_TEXT } from "./limits";
import { edited, load, reason, report, Superseded } from "./session";
import { fitNext } from "./sheet";
import { announce, held, message, openings, selection, text } from "./state";

/** Texts kept for undoing; a text is at most 2 MB. */
const MOST = 200;
/** Changes typed within this time are one step of the history, ms. */
const PAUSE = 900;

export const past = signal<string[]>([]);
export const future = signal<string[]>([]);
export const fileName = signal("mechanism.toml");
let typedAt = 0;

/** Begin with another text. Returns why the core could not read it at all, else null. */
export async function open(given: string, name = "mechanism.toml"): Promise<string | null> {
  if (isTooLarge(given)) return texts.core.tooLarge;
  openings.value += 1;
  past.value = [];
  future.value = [];
  fileName.value = name;
  selection.value = null;
  held.value = new Set();
  fitNext();
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

/** Take up a text; `record` makes it a step of the history, after the text `before`. */
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

/** A text typed by hand: quick changes are one step. */
export async function type(given: string): Promise<void> {
  const now = Date.now();
  const record = now - typedAt > PAUSE;
  typedAt = now;
  await take(given, record);
}

function remember(before: string): void {
  past.value = [...past.value.slice(1 - MOST), before];
  future.value = [];
}

/** Change the text through the core, as one step of the history; returns whether it succeeded. */
export async function change(changes: Change[]): Promise<boolean> {
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

/** A change that goes on, such as a drag: only its end is a step of the history. */
export class Draft {
  private readonly before = text.value;
  private latest: Change[] | null = null;
  private working: Promise<void> | null = null;

  /** Show these changes; while some are under way, only the newest of the others is kept. */
  show(changes: Change[]): void {
    this.latest = changes;
    this.working ??= this.work();
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

  /** Keep what is shown. */
  async keep(): Promise<void> {
    await this.working;
    if (text.value !== this.before) remember(this.before);
  }

  /** Go back to the text before. */
  async drop(): Promise<void> {
    this.latest = null;
    await this.working;
    if (text.value !== this.before) await take(this.before, false);
  }
}

export async function undo(): Promise<void> {
  const before = past.value.at(-1);
  if (before === undefined) return;
  past.value = past.value.slice(0, -1);
  future.value = [...future.value, text.value];
  await take(before, false);
}

export async function redo(): Promise<void> {
  const after = future.value.at(-1);
  if (after === undefined) return;
  future.value = future.value.slice(0, -1);
  past.value = [...past.value, text.value];
  await take(after, false);
}
