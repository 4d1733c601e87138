// The typed length of the line in progress.
import { effect } from "@preact/signals";
import { lengthMeant, meantValue } from "../edit/meaning";
import { typed } from "../edit/values";
import { report } from "../store/session";
import { typedLength } from "../store/sheet";
import { units } from "../store/state";

/** A typed formula is read when no other key follows within this time, ms. */
const PAUSE = 200;

/** The last text that was read, with its unit, and its length in m. A faulty text has no length. */
let meant: { text: string; unit: string; length: number | undefined } = { text: "", unit: "", length: undefined };

/** The typed length in m, if it has been read. */
export function lengthNow(): number | undefined {
  const isSame = typedLength.value === meant.text && units.value.length === meant.unit;
  return isSame ? meant.length : undefined;
}

/** Read the typed length. A fault is shown; then the result is false. */
export async function readLength(): Promise<boolean> {
  const text = typedLength.value;
  if (!text.trim() || lengthNow() !== undefined) return true;
  const unit = units.value.length;
  const length = meantValue(await lengthMeant(text));
  meant = { text, unit, length };
  return length !== undefined;
}

let timer: ReturnType<typeof setTimeout> | undefined;

effect(() => {
  const text = typedLength.value;
  const unit = units.value.length;
  clearTimeout(timer);
  if (!text.trim()) return;
  const read = () =>
    lengthMeant(text).then((found) => {
      meant = { text, unit, length: "value" in found ? found.value : undefined };
    }, report);
  timer = setTimeout(() => void read(), typeof typed(text) === "string" ? PAUSE : 0);
});
