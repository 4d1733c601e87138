// Pictures of the plots.
import { drawn } from "../modes/plotting";
import { time, variable } from "../modes/read";
import { written } from "../modes/shown";
import { paintPlots, sizeOf } from "../plot/picture";
import { plots } from "../store/plots";
import { title } from "../store/state";
import { nameOf } from "./download";
import { savePng, saveSvg } from "./picture";

/** Save all plots with their legends, one below the other. */
export function savePlots(kind: "png" | "svg"): void {
  const found = plots.value.flatMap(({ key }) => drawn.get(key) ?? []);
  if (!found.length) return;
  const all = found.map((plot) => ({
    plot,
    entries: plot.curves.filter((one) => !one.stored).map((curve) => ({ curve, text: plot.write(curve, time.value) })),
  }));
  const { name, unit } = variable.value;
  const head = { title: title.value, t: time.value, instant: `${name} = ${written(time.value, unit)}` };
  const save = kind === "png" ? savePng : saveSvg;
  save(nameOf(title.value, `_plots.${kind}`), sizeOf(all), (context, colours) =>
    paintPlots(context, all, head, colours),
  );
}
