// The parameters of the case as sliders, and the slopes of a chosen number beside them.
import { effect, signal } from "@preact/signals";
import type { Tree } from "../core/protocol";
import { CoreError } from "../core/transport";
import { bounds, measure, rewritten } from "../design/improve";
import { displayed } from "../draw/display";
import { minus, significant } from "../draw/numbers";
import { Draft } from "../store/document";
import { report, send } from "../store/session";
import { loads, mechanism, openings, tree, units } from "../store/state";
import { texts } from "../texts";
import { Improve } from "./Improve";
import { Button } from "./parts";
import { shown } from "./Readings";

interface Slopes {
  measure: string;
  /** The text for which they hold, by the count of loads. */
  of: number;
  value: number;
  unit: string;
  slopes: { name: string; slope: number | null; remark: string | null }[];
}

const slopes = signal<Slopes | null>(null);
const fault = signal("");
const busy = signal(false);
/** The ends of each slider while the page is open, in SI units. */
const ranges = signal<Record<string, [number, number]>>({});

effect(() => {
  openings.value;
  ranges.value = {};
  slopes.value = null;
  fault.value = "";
});

/** Compute the slopes of the chosen number by all parameters. */
async function compute(): Promise<void> {
  const chosen = measure.value.trim();
  if (!chosen || busy.value) return;
  busy.value = true;
  fault.value = "";
  try {
    const of = loads.value;
    const { ok } = await send("slopes", { measure: chosen });
    slopes.value = { ...ok, measure: chosen, of };
  } catch (error) {
    slopes.value = null;
    if (error instanceof CoreError) {
      const { message, hint } = error.problem;
      fault.value = hint ? `${message}; ${hint}` : message;
    } else report(error);
  }
  busy.value = false;
}

/** The slope in percent of the number, for a small step of the parameter: "+3.1 % per mm". */
function told({ value, slopes: all }: Slopes, name: string, parameter: number, unit: string | null): string {
  const words = texts.slopes;
  const one = all.find((of) => of.name === name);
  if (!one) return "";
  if (one.slope === null) return one.remark ?? words.none;
  const step = STEPS[unit ?? ""];
  const [by, per] = step ?? [0.01 * Math.abs(parameter), "1 %"];
  const share = (100 * one.slope * by) / Math.abs(value);
  if (!Number.isFinite(share)) return words.none;
  const sign = share > 0 ? "+" : "";
  return words.per(`${sign}${minus(significant(share, 2))}`, per) + (one.remark ? ` (${one.remark})` : "");
}

/** Steps by which people change a parameter with such a unit, in SI units. */
const STEPS: Record<string, [number, string]> = { m: [1e-3, "mm"], rad: [Math.PI / 180, "°"] };

export function Sliders() {
  const words = texts.slopes;
  const all = mechanism.value?.parameters ?? [];
  if (!all.length) return null;
  const found = slopes.value?.of === loads.value ? slopes.value : null;
  return (
    <details class="sliders">
      <summary>{words.title}</summary>
      {all.map((one) => (
        <Slider key={one.name} {...one} slope={found ? told(found, one.name, one.value, one.unit) : ""} />
      ))}
      <form
        class="adding"
        onSubmit={(event) => {
          event.preventDefault();
          void compute();
        }}
      >
        <input
          id="slope-measure"
          type="text"
          aria-label={words.measure}
          placeholder={words.measure}
          autocomplete="off"
          value={measure.value}
          onInput={(event) => (measure.value = event.currentTarget.value)}
        />
        <Button label={busy.value ? words.busy : words.compute} onClick={() => void compute()} id="slopes" />
      </form>
      <p class={fault.value ? "doc wrong" : "doc"} role="status" id="slopes-of">
        {fault.value ||
          (found ? words.of(found.measure, shown(found.value, found.unit)) : slopes.value ? words.old : "")}
      </p>
      <Improve />
    </details>
  );
}

interface SliderProps {
  name: string;
  value: number;
  unit: string | null;
  slope: string;
}

let draft: Draft | null = null;

/** A parameter as a slider. Its ends are typed; the text changes with it, and the drag is one step of the history. */
function Slider({ name, value, unit, slope }: SliderProps) {
  const { factor, unit: name_of } = displayed(unit ?? "", units.value);
  const varied = bounds.value[name];
  const own = (varied as [number, number] | undefined) ?? ranges.value[name];
  const [low, high] =
    own ?? (value === 0 ? [-1, 1] : [Math.min(0.5 * value, 1.5 * value), Math.max(0.5 * value, 1.5 * value)]);
  const formula = typeof (tree.value?.parameters as Tree | undefined)?.[name] === "string" && isFormula(name);
  const move = (to: number) => {
    draft ??= new Draft();
    // the ends stay where they are while the value moves
    if (!own) ranges.value = { ...ranges.value, [name]: [low, high] };
    draft.show([{ path: ["parameters", name], value: rewritten(name, to, 4) }]);
  };
  const keep = () => {
    void draft?.keep().catch(report);
    draft = null;
  };
  const end = (k: 0 | 1, text: string) => {
    const given = Number(text.replace(",", ".")) / factor;
    const next: [number, number] = k === 0 ? [given, high] : [low, given];
    if (!Number.isFinite(given) || next[0] >= next[1]) return;
    ranges.value = { ...ranges.value, [name]: next };
    if (varied) bounds.value = { ...bounds.value, [name]: [...next, ...varied.slice(2)] };
  };
  const vary = (on: boolean) => {
    const { [name]: _, ...others } = bounds.value;
    bounds.value = on ? { ...others, [name]: [low, high] } : others;
  };
  const plain = (x: number) => String(Number((x * factor).toPrecision(6)));
  return (
    <div class="slider ranged">
      <div class="named">
        <input
          type="checkbox"
          id={`vary-${name}`}
          aria-label={texts.slopes.vary(name)}
          title={texts.slopes.varyHint}
          checked={varied !== undefined}
          disabled={formula}
          onChange={(event) => vary(event.currentTarget.checked)}
        />
        <label for={`slider-${name}`}>
          <bdi>{name}</bdi>
          <output>{shown(value, unit ?? "")}</output>
          <output class="slope" id={`slope-${name}`}>
            {slope}
          </output>
        </label>
      </div>
      <div class="ends">
        <input
          type="text"
          aria-label={texts.slopes.least(name, name_of)}
          value={plain(low)}
          onChange={(event) => end(0, event.currentTarget.value)}
        />
        <input
          id={`slider-${name}`}
          type="range"
          min={Math.min(low, value)}
          max={Math.max(high, value)}
          step="any"
          value={value}
          disabled={formula}
          title={formula ? texts.slopes.formula : undefined}
          onInput={(event) => move(Number(event.currentTarget.value))}
          onChange={keep}
        />
        <input
          type="text"
          aria-label={texts.slopes.most(name, name_of)}
          value={plain(high)}
          onChange={(event) => end(1, event.currentTarget.value)}
        />
      </div>
    </div>
  );
}

/** Whether a parameter follows from others, so that it has no slider of its own. */
function isFormula(name: string): boolean {
  const text = String((tree.value?.parameters as Tree | undefined)?.[name] ?? "");
  const others = (mechanism.value?.parameters ?? []).map((one) => one.name).filter((one) => one !== name);
  return others.some((one) => new RegExp(`(?<![\\w.])${one}(?![\\w.])`).test(text));
}
