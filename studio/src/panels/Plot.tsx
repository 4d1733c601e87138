// One plot over time or a quantity, with its curves, their peaks, and the instant that is shown.
import { useEffect, useRef, useState } from "preact/hooks";
import uPlot from "uplot";
import { displayed } from "../draw/display";
import { minus, readable, withUnit } from "../draw/numbers";
import { font, palette } from "../draw/surface";
import type { Stored } from "../give/stored";
import { course, quantities, show, time, valuesOf, variable } from "../modes/read";
import { type PlotOf, plots, stored } from "../store/plots";
import { report } from "../store/session";
import { degrees } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

const HEIGHT = 190;
/** Distances of ticks on axes in degrees. */
const DEGREES = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360, 720, 1800, 3600, 7200, 18000, 36000];

interface Curves {
  names: string[];
  /** The SI unit. */
  base: string;
  units: string[];
  rows: Float64Array[];
}

export function Plot({ plot }: { plot: PlotOf }) {
  const [curves, setCurves] = useState<Curves | null>(null);
  const host = useRef<HTMLDivElement>(null);
  const drawn = useRef<uPlot | null>(null);
  const run = course.value;
  const turn = degrees.value;
  const other = stored.value;
  useEffect(() => {
    if (!run) return;
    let current = true;
    void valuesOf(plot.names)
      .then(
        ({ units, rows }) =>
          current && setCurves({ names: plot.names, base: units[0] ?? "", ...inUnits(units, rows, turn) }),
      )
      .catch(report);
    return () => {
      current = false;
    };
  }, [plot.names.join(), run, turn]);
  useEffect(() => {
    if (!curves || !run || !host.current) return;
    const across = acrossOf(turn);
    const made = draw(host.current, run.t, across, curves, other ? besides(other, curves, turn) : null);
    drawn.current = made;
    const observer = new ResizeObserver(() =>
      made.setSize({ width: host.current?.clientWidth ?? 300, height: HEIGHT }),
    );
    observer.observe(host.current);
    return () => {
      observer.disconnect();
      made.destroy();
      drawn.current = null;
    };
  }, [curves, run, other]);
  const now = time.value;
  useEffect(() => drawn.current?.redraw(false), [now]);
  return (
    <article class="plot">
      <div ref={host} class="curves" role="img" aria-label={plot.names.join(", ")} />
      <ul class="legend">
        {curves?.names.map((name, k) => (
          <Entry
            key={name}
            name={name}
            unit={curves.units[k] ?? ""}
            row={curves.rows[k]!}
            number={k}
            plot={plot}
            base={curves.base}
          />
        ))}
      </ul>
      <AddCurve plot={plot} base={curves?.base ?? ""} />
    </article>
  );
}

function Entry({
  name,
  unit,
  row,
  number,
  plot,
  base,
}: {
  name: string;
  base: string;
  unit: string;
  row: Float64Array;
  number: number;
  plot: PlotOf;
}) {
  const beside = stored.value?.rows.get(name);
  const { factor } = displayed(base, degrees.value);
  const remove = () => {
    const names = plot.names.filter((one) => one !== name);
    plots.value = plots.value.flatMap((one) =>
      one.key !== plot.key ? [one] : names.length ? [{ ...one, names }] : [],
    );
  };
  return (
    <li>
      <i class={`mark mark-${(number % 7) + 1}`} />
      <bdi class="name">{name}</bdi>
      <span class="value">{`${texts.read.peak} ${withUnit(peakOf(row), unit)}`}</span>
      {beside ? <span class="value">{`${texts.read.stored} ${withUnit(peakOf(beside) * factor, unit)}`}</span> : null}
      <Button label={`${texts.properties.remove} ${name}`} icon="close" kind="small" onClick={remove} />
    </li>
  );
}

function AddCurve({ plot, base }: { plot: PlotOf; base: string }) {
  const all = quantities.value.filter((one) => one.unit === base && !plot.names.includes(one.name));
  if (!all.length) return null;
  const add = (name: string) => {
    if (name)
      plots.value = plots.value.map((one) => (one.key === plot.key ? { ...one, names: [...one.names, name] } : one));
  };
  return (
    <select
      class="wide"
      aria-label={texts.read.addQuantity}
      value=""
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

/** The value of the largest magnitude. */
function peakOf(row: Float64Array): number {
  let peak = 0;
  for (const value of row) if (Math.abs(value) > Math.abs(peak)) peak = value;
  return peak;
}

/** Values in display units. */
function inUnits(units: string[], rows: Float64Array[], turn: boolean): Pick<Curves, "units" | "rows"> {
  const shown = units.map((unit) => displayed(unit, turn));
  const scaled = (row: Float64Array, factor: number) => (factor === 1 ? row : row.map((value) => value * factor));
  return { units: shown.map(({ unit }) => unit), rows: rows.map((row, k) => scaled(row, shown[k]?.factor ?? 1)) };
}

/** The horizontal axis: its label, and by what to multiply values in SI units. */
interface Across {
  label: string;
  unit: string;
  factor: number;
}

function acrossOf(turn: boolean): Across {
  const { name, unit: base } = variable.peek();
  const { factor, unit } = displayed(base, turn);
  return { label: `${name} / ${unit}`, unit, factor };
}

/** The curves of a stored run that has some of these quantities. */
function besides(other: Stored, { names, base }: Curves, turn: boolean): Beside | null {
  const { factor } = displayed(base, turn);
  const t = placesOf(other, variable.peek().name);
  if (!t) return null;
  const found = names.flatMap((name, k): Beside["curves"] => {
    const row = other.rows.get(name);
    return row ? [{ number: k, row: row.map((value) => value * factor) }] : [];
  });
  return { t, curves: found };
}

/** Where the values of a stored run are on the axis; null if they do not grow. */
function placesOf({ t, rows }: Stored, name: string): Float64Array | null {
  const found = rows.get(name) ?? t;
  return found.every((value, k) => k === 0 || value >= found[k - 1]!) ? found : null;
}

interface Beside {
  t: Float64Array;
  /** Each with the number of the curve of the same quantity. */
  curves: { number: number; row: Float64Array }[];
}

function draw(
  host: HTMLElement,
  t: Float64Array,
  across: Across,
  { names, units, rows }: Curves,
  beside: Beside | null,
): uPlot {
  const colours = palette();
  const axis = {
    stroke: colours.named.soft!,
    grid: { stroke: colours.named.grid! },
    ticks: { stroke: colours.named.edge! },
    font: font(11),
    values: (_: uPlot, values: number[]) => values.map((value) => minus(String(Number(value.toPrecision(6))))),
  };
  const unit = readable(units[0] ?? "");
  const ticks = (of: string) => (of === "°" ? { incrs: DEGREES } : {});
  return new uPlot(
    {
      width: host.clientWidth || 300,
      height: HEIGHT,
      pxAlign: 0,
      legend: { show: false },
      cursor: { drag: { x: true, y: false } },
      scales: { x: { time: false } },
      series: [
        {},
        ...names.map((name, k) => ({ label: name, stroke: colours.body(k + 1), width: 1.6, spanGaps: true })),
        ...(beside?.curves ?? []).map(({ number }) => ({
          label: `${names[number]}, ${texts.read.stored}`,
          stroke: colours.body(number + 1),
          width: 1.6,
          dash: [6, 5],
          spanGaps: true,
        })),
      ],
      axes: [
        { ...axis, ...ticks(across.unit), label: across.label, labelSize: 16, labelFont: font(11), size: 34 },
        {
          ...axis,
          ...ticks(unit),
          label: /[/ ]/.test(unit) ? `(${unit})` : unit,
          labelSize: 16,
          labelFont: font(11),
          size: 56,
        },
      ],
      hooks: {
        draw: [(plot) => cursorLine(plot, across.factor, colours.named.accent!)],
        ready: [
          (plot) =>
            plot.over.addEventListener("click", (event) => show(plot.posToVal(event.offsetX, "x") / across.factor)),
        ],
      },
    },
    joined(t, across.factor, rows, beside),
    host,
  );
}

/** Present and stored curves over the times of both. */
function joined(t: Float64Array, factor: number, rows: Float64Array[], beside: Beside | null): uPlot.AlignedData {
  const scaled = (values: Float64Array) => values.map((value) => value * factor);
  const present = [scaled(t), ...rows] as unknown as uPlot.AlignedData;
  if (!beside?.curves.length) return present;
  const other = [scaled(beside.t), ...beside.curves.map(({ row }) => row)] as unknown as uPlot.AlignedData;
  return uPlot.join([present, other]);
}

/** A line at the instant that the drawing shows. */
function cursorLine({ ctx, bbox, valToPos }: uPlot, factor: number, colour: string): void {
  const x = Math.round(valToPos(time.peek() * factor, "x", true));
  if (x < bbox.left || x > bbox.left + bbox.width) return;
  ctx.save();
  ctx.strokeStyle = colour;
  ctx.lineWidth = devicePixelRatio;
  ctx.beginPath();
  ctx.moveTo(x, bbox.top);
  ctx.lineTo(x, bbox.top + bbox.height);
  ctx.stroke();
  ctx.restore();
}
