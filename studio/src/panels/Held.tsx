// Switches that hold points, lengths and the angle of a body during a drag.
import { ofAngle, ofLengths, ofPoint } from "../edit/holding";
import { held, mechanism } from "../store/state";
import { texts } from "../texts";
import { Check, Section } from "./parts";

export function Held({ name }: { name: string }) {
  const words = texts.properties;
  const body = mechanism.value?.bodies.find((one) => one.name === name);
  if (!body) return null;
  const points = Object.keys(body.points).map((point): [string, string] => [point, ofPoint(name, point)]);
  const own: [string, string][] = [
    [words.lengths, ofLengths(name)],
    [words.angle, ofAngle(name)],
  ];
  const all = [...(body.ground || points.length < 2 ? [] : own), ...points];
  return all.length ? (
    <Section title={words.held}>
      <div class="locks">
        {all.map(([label, key]) => (
          <Check key={key} label={label} checked={held.value.has(key)} onChange={(on) => keep(key, on)} />
        ))}
      </div>
    </Section>
  ) : null;
}

function keep(key: string, on: boolean): void {
  const next = new Set(held.value);
  if (on) next.add(key);
  else next.delete(key);
  held.value = next;
}
