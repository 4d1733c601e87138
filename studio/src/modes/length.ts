// The length that is typed for the line that is being drawn.
import { effect } from "@preact/signals";
import { lengthMeant, meantValue } from "../edit/meaning";
import { typed } from "../edit/values";
import { report } from "../store/session";
import { typedLength } from "../store/sheet";
import { units } from "../store/state";

/** A formula is read for the line under the pointer after this time without another key, ms. */
const PAUSE = 200;

/** The text that was read last with its unit, and its length in m; without a length it has a fault. */
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
