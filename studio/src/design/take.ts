// A candidate becomes the mechanism of the case.
import { entry } from "../catalogue/tree";
import type { Change } from "../core/protocol";
import { change } from "../store/document";
import { report, send } from "../store/session";
import { announce, tree } from "../store/state";
import { texts } from "../texts";
import { chosen, stop, taken } from "./task";

/** The first entry of the case that a change would replace, such as "body crank". */
function replaced(changes: Change[]): string | null {
  for (const one of changes) {
    const [group, name] = one.path;
    if (!("value" in one) || one.path.length !== 2 || group === "synthesis") continue;
    if (entry(tree.value, group!, name!)) return `${group}.${name}`;
  }
  return null;
}

/** Write the shown candidate into the case; a linkage that was taken before is replaced. */
export async function take(): Promise<boolean> {
  const starts = await stop();
  try {
    const { ok } = await send("candidate", { choice: chosen.value + 1 });
    const old = taken.value === null ? replaced(ok.changes) : null;
    if (old) {
      announce("problem", texts.design.occupied(old), { hint: texts.design.occupiedHint });
      return false;
    }
    if (starts) ok.changes.push({ path: ["synthesis", "starts"], value: starts });
    return await change(ok.changes);
  } catch (error) {
    report(error);
    return false;
  }
}
