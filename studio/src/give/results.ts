// Results as files.
import { course, valuesOf } from "../modes/read";
import { plots } from "../store/plots";
import { report } from "../store/session";
import { mechanism, title } from "../store/state";
import { download, nameOf } from "./download";
import { type NumbersOf, npz } from "./npz";
import { csv } from "./table";

function plotted(): string[] {
  return [...new Set(plots.value.flatMap(({ names }) => names))];
}

export async function saveCsv(): Promise<void> {
  const run = course.value;
  if (!run) return;
  try {
    const names = plotted();
    const { units, rows } = await valuesOf(names);
    download(nameOf(title.value, ".csv"), csv(run.t, names, units, rows), "text/csv;charset=utf-8");
  } catch (error) {
    report(error);
  }
}

/** Times, the poses of the bodies by name, and the plotted quantities. */
export async function saveNpz(): Promise<void> {
  const run = course.value;
  if (!run) return;
  try {
    const names = plotted();
    const { rows } = await valuesOf(names);
    const n = run.t.length;
    const arrays: Record<string, NumbersOf> = { t: { shape: [n], values: run.t } };
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
    download(nameOf(title.value, ".npz"), npz(arrays) as BlobPart, "application/zip");
  } catch (error) {
    report(error);
  }
}
