// The speeds of drivers, which are parameters of their laws. They may be typed in any unit.
import { entries } from "../catalogue/tree";
import { speedsOf } from "../edit/driving";
import { rateOf } from "../edit/start";
import { written } from "../edit/values";
import { report } from "../store/session";
import { mechanism, pose, tree } from "../store/state";
import { texts } from "../texts";
import { putTyped } from "./Field";
import { Facts, Section } from "./parts";
import { shown } from "./Readings";
import { TextField } from "./TextField";

/** The speeds of all drivers, or of one. */
export function Speeds({ of }: { of?: string }) {
  const all = speedsOf(tree.value, mechanism.value?.parameters ?? []).filter(({ driver }) => !of || driver === of);
  const own = all.filter(({ parameter }, k) => all.findIndex((one) => one.parameter === parameter) === k);
  const rates = Object.entries(entries(tree.value, "drivers")).flatMap(([name, { coordinate }]) =>
    of && name !== of ? [] : rateNow(String(coordinate)),
  );
  if (!own.length && !rates.length) return null;
  const parameters = entries(tree.value, "parameters");
  return (
    <Section title={texts.move.speeds}>
      {own.map(({ parameter }) => (
        <TextField
          key={parameter}
          label={parameter}
          hint={texts.move.speedHint}
          value={written(parameters[parameter])}
          keep={(text) => void putTyped(["parameters", parameter], text).catch(report)}
        />
      ))}
      <Facts
        rows={[...own.map(({ parameter, value, unit }): [string, string] => [parameter, shown(value, unit)]), ...rates]}
      />
    </Section>
  );
}

/** The present rate of a coordinate of a body. */
function rateNow(coordinate: string): [string, string][] {
  const [name, which] = coordinate.split(".");
  const k = (mechanism.value?.bodies ?? []).findIndex((body) => body.name === name);
  const rates = pose.value?.rates[k - 1];
  const place = ["x", "y", "angle"].indexOf(which ?? "");
  if (!rates || place < 0 || coordinate.split(".").length > 2) return [];
  return [[rateOf(coordinate)!, shown(rates[place]!, place === 2 ? "rad/s" : "m/s")]];
}
