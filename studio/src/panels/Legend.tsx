// The legend of a plot: the names of the curves, their values at the shown time, and their peaks.
import { displayed } from "../draw/display";
import { withUnit } from "../draw/numbers";
import { dashOf } from "../draw/surface";
import { looked, stretched } from "../modes/plotting";
import { starred, time } from "../modes/read";
import type { Curve } from "../plot/curve";
import type { Plot } from "../plot/plot";
import { peakOf } from "../plot/straight";
import { type PlotOf, plots } from "../store/plots";
import { units } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

interface Props {
  of: PlotOf;
  plot: Plot;
  curves: readonly Curve[];
}

export function Legend({ of, plot, curves }: Props) {
  const present = curves.filter((one) => !one.stored);
  return (
    <ul class="legend">
      {present.map((curve) => (
        <Entry
          key={curve.name}
          of={of}
          plot={plot}
          curve={curve}
          beside={curves.find((one) => one.stored && one.name === curve.name)}
        />
      ))}
    </ul>
  );
}

interface EntryProps {
  of: PlotOf;
  plot: Plot;
  curve: Curve;
  beside: Curve | undefined;
}

function Entry({ of, plot, curve, beside }: EntryProps) {
  const { factor, unit } = displayed(curve.unit, units.value);
  const peak = (one: Curve) => withUnit(peakOf(one) * factor, unit);
  const remove = () => {
    const names = of.names.filter((one) => one !== curve.name);
    plots.value = plots.value.flatMap((one) => (one.key !== of.key ? [one] : names.length ? [{ ...one, names }] : []));
  };
  return (
    <li>
      <svg class={`mark mark-${(curve.number % 7) + 1}`} viewBox="0 0 26 8" aria-hidden="true">
        <line x1="1" y1="4" x2="25" y2="4" stroke-dasharray={dashOf(curve.number).join(" ")} />
      </svg>
      <bdi class="name" title={curve.name}>
        {starred(curve.name, curve.name.split(".")[0]!, curve.unit)}
      </bdi>
      <Now plot={plot} curve={curve} />
      <span class="value">{`${texts.read.peak} ${peak(curve)}`}</span>
      {beside ? <span class="value">{`${texts.read.stored} ${peak(beside)}`}</span> : null}
      <Button label={`${texts.properties.remove} ${curve.name}`} icon="close" kind="small" onClick={remove} />
    </li>
  );
}

/** The value at the time under the pointer; without a pointer, at the shown time. */
function Now({ plot, curve }: { plot: Plot; curve: Curve }) {
  stretched.value; // follow changes of the curves and units of the plot
  const text = plot.curves.includes(curve) ? plot.write(curve, looked.value ?? time.value) : "";
  return <output class="now">{text}</output>;
}
