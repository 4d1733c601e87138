// The text of the case and its history. Each change, by keyboard or mouse, changes the text.
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

/** Open another text. Returns the reason if the core could not read it, otherwise null. */
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

/** Replace the text while the user types. Quick changes are one step of the history. */
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
