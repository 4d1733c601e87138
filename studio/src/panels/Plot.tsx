// One plot over time or a quantity, with its curves, their values and peaks, and the shown instant.
import { effect } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import { soon } from "../draw/soon";
import { palette } from "../draw/surface";
import { across, curvesOf, drawn, looked, shownSpan, stretched } from "../modes/plotting";
import { course, quantities, show, time, valuesOf } from "../modes/read";
import type { Curve } from "../plot/curve";
import { seekable } from "../plot/gestures";
import { Plot } from "../plot/plot";
import { symbolOf } from "../plot/straight";
import { type PlotOf, plots, stored } from "../store/plots";
import { report } from "../store/session";
import { units } from "../store/state";
import { texts } from "../texts";
import { Legend } from "./Legend";
import { Check } from "./parts";

export function PlotCard({ plot: of }: { plot: PlotOf }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [plot, setPlot] = useState<Plot | null>(null);
  const [log, setLog] = useState(false);
  const curves = useCurves(of.names);
  useEffect(() => {
    const made = new Plot(canvas.current!, shownSpan.peek(), across.peek());
    setPlot(made);
    return connect(made);
  }, []);
  const shownUnits = units.value;
  const shown = shownSpan.value;
  useEffect(() => {
    if (!plot) return;
    Object.assign(plot, { log, units: shownUnits });
    plot.over(shown, across.peek());
    plot.show(curves, symbolOf(of.names));
    stretched.value += 1;
    drawn.set(of.key, plot);
    return () => void drawn.delete(of.key);
  }, [plot, curves, log, shownUnits, shown]);
  return (
    <article class="plot">
      <canvas ref={canvas} class="curves" role="img" tabIndex={0} aria-label={texts.read.plotOf(of.names.join(", "))} />
      {plot ? <Legend of={of} plot={plot} curves={curves} /> : null}
      <div class="buttons">
        <AddCurve of={of} unit={curves[0]?.unit ?? ""} />
        <Check label={texts.read.log} hint={texts.read.logHint} checked={log} onChange={setLog} />
      </div>
    </article>
  );
}

/** The curves of some quantities over the present run and the stored one. */
function useCurves(names: readonly string[]): Curve[] {
  const [curves, setCurves] = useState<Curve[]>([]);
  const [run, other] = [course.value, stored.value];
  useEffect(() => {
    if (!run) return;
    let current = true;
    void valuesOf([...names])
      .then(({ units, rows }) => current && setCurves(curvesOf(names, units, rows)))
      .catch(report);
    return () => {
      current = false;
    };
  }, [names.join(), run, other]);
  return curves;
}

/** Connect gestures, and paint after each change of the plot. Returns a function that ends both. */
function connect(plot: Plot): () => void {
  let colours = palette();
  const paint = soon(() => {
    shownSpan.peek().follow(time.peek());
    plot.paint(time.peek(), looked.peek(), colours);
  });
  const changed = () => {
    stretched.value += 1;
  };
  const quit = seekable(plot.canvas, {
    timeAt: (px) => plot.timeAt(px),
    seek: show,
    look: (at) => {
      plot.pointer = at;
      looked.value = at && plot.timeAt(at[0]);
      changed();
    },
    stretch: (factor, px) => {
      shownSpan.peek().stretch(factor, plot.timeAt(px));
      changed();
    },
    showAll: () => {
      shownSpan.peek().showAll();
      changed();
    },
  });
  const stop = effect(() => {
    for (const one of [time, looked, stretched]) one.value;
    paint();
  });
  const observer = new ResizeObserver(() => {
    plot.resize();
    paint();
  });
  observer.observe(plot.canvas);
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const recolour = () => {
    colours = palette();
    paint();
  };
  dark.addEventListener("change", recolour);
  return () => {
    for (const end of [quit, stop]) end();
    observer.disconnect();
    dark.removeEventListener("change", recolour);
  };
}

function AddCurve({ of, unit }: { of: PlotOf; unit: string }) {
  const all = quantities.value.filter((one) => one.unit === unit && !of.names.includes(one.name));
  const add = (name: string) => {
    if (name)
      plots.value = plots.value.map((one) => (one.key === of.key ? { ...one, names: [...one.names, name] } : one));
  };
  return (
    <select
      class="wide"
      aria-label={texts.read.addQuantity}
      value=""
      disabled={!all.length}
      onChange={(event) => add(event.currentTarget.value)}
    >
      <option value="">{texts.read.addQuantity}</option>
      {all.map(({ name }) => (
        <option key={name} value={name}>
          {name}
        </option>
      ))}
    </select>
  );
}
