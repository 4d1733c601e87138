// A result that is not a motion: its values, and the choice of the drawn position.
import type { Fact } from "../core/protocol";
import { found, place, showPlace } from "../modes/read";
import { texts } from "../texts";
import { Facts, Section } from "./parts";
import { shown } from "./Readings";

export function Findings() {
  const result = found.value;
  if (!result) return null;
  const words = texts.read;
  const { facts, positions } = result;
  return (
    <Section title={words.findings}>
      <div id="findings">
        {facts.length ? (
          <Facts rows={facts.map((one) => [one.name, valueText(one)])} />
        ) : (
          <p class="doc">{words.nothing}</p>
        )}
      </div>
      {positions.length > 1 ? (
        <label class="choice">
          <span>{words.position}</span>
          <select
            id="position"
            value={String(place.value)}
            onChange={(event) => void showPlace(Number(event.currentTarget.value))}
          >
            {positions.map((one, k) => (
              <option key={k} value={String(k)}>
                {nameOf(one)}
              </option>
            ))}
          </select>
        </label>
      ) : null}
      {positions.length === 1 ? <p class="doc">{words.drawn(nameOf(positions[0]!))}</p> : null}
    </Section>
  );
}

/** The name of a position, with its value if it has one. */
function nameOf(one: Fact): string {
  return one.value === null ? one.name : `${one.name} = ${valueText(one)}`;
}

/** A text, a count, or a number in the units of the display. */
function valueText({ value, unit }: Fact): string {
  if (typeof value !== "number") return value ?? texts.properties.absent;
  return Number.isInteger(value) && !unit ? String(value) : shown(value, unit);
}
