// Results as files.
import { condition, course, valuesOf, variable } from "../modes/read";
import { plots, stored } from "../store/plots";
import { report } from "../store/session";
import { announce, mechanism, title } from "../store/state";
import { texts } from "../texts";
import { choose } from "./choose";
import { download, nameOf } from "./download";
import { type Contents, type NumbersOf, npz, readNpz } from "./npz";
import { storedRun } from "./stored";
import { csv } from "./table";

function plotted(): string[] {
  return [...new Set(plots.value.flatMap(({ names }) => names))];
}

export async function saveCsv(): Promise<void> {
  const run = course.value;
  if (!run) return;
  try {
    const first = { ...variable.value, condition: condition.value };
    const names = plotted().filter((name) => name !== first.name);
    const { units, rows } = await valuesOf(names);
    download(nameOf(title.value, ".csv"), csv(run.t, names, units, rows, first), "text/csv;charset=utf-8");
  } catch (error) {
    report(error);
  }
}

/** Save times, poses of the bodies by name, and plotted quantities; `variable` names the variable of the run. */
export async function saveNpz(): Promise<void> {
  const run = course.value;
  if (!run) return;
  try {
    const names = plotted();
    const { rows } = await valuesOf(names);
    const n = run.t.length;
    const times = { shape: [n], values: run.t };
    const arrays: Record<string, NumbersOf> = { t: times, [variable.value.name]: times };
    mechanism.value?.bodies.slice(1).forEach(({ name }, body) => {
      const values = Float64Array.from(
        { length: 3 * n },
        (_, k) => run.rows[Math.floor(k / 3) * run.width + 1 + 3 * body + (k % 3)]!,
      );
      arrays[name] = { shape: [n, 3], values };
    });
    names.forEach((name, k) => {
      arrays[name] = { shape: [n], values: rows[k]! };
    });
    const { name, unit } = variable.value;
    download(nameOf(title.value, ".npz"), npz(arrays, { variable: [name, unit] }) as BlobPart, "application/zip");
  } catch (error) {
    report(error);
  }
}

/** Let the user choose a stored run. Its curves are drawn in the same plots. */
export function openStored(): void {
  choose(".npz", async (file) => {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const found = storedRun(file.name, tryRead(bytes), mechanism.value?.coordinates ?? []);
    stored.value = found;
    if (found) announce("done", texts.read.compared(file.name, found.rows.size));
    else announce("problem", texts.read.notCompared(file.name));
  });
}

function tryRead(bytes: Uint8Array): Contents {
  try {
    return readNpz(bytes);
  } catch {
    return { arrays: {}, texts: {} };
  }
}
