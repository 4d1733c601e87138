// The quantity and the range of kinematics over a quantity.
import { useEffect } from "preact/hooks";
import { follow, offer, over, positions, range, unit, writeRange } from "../modes/over";
import { report, send } from "../store/session";
import { loads } from "../store/state";
import { texts } from "../texts";

export function OverFields() {
  const words = texts.read;
  const version = loads.value;
  useEffect(() => {
    let current = true;
    void send("quantities", {}).then(({ ok }) => current && offer(ok), report);
    return () => {
      current = false;
    };
  }, [version]);
  const field = (side: 0 | 1, label: string) => (
    <label class="choice">
      <span>{unit.value ? `${label} / ${unit.value}` : label}</span>
      <input
        type="text"
        id={side === 0 ? "over-first" : "over-last"}
        size={5}
        value={range.value[side]}
        autocomplete="off"
        spellcheck={false}
        onInput={(event) => writeRange(side, event.currentTarget.value)}
      />
    </label>
  );
  return (
    <>
      <select
        id="over"
        aria-label={words.quantityOver}
        value={over.value?.name ?? ""}
        onChange={(event) => follow(event.currentTarget.value)}
      >
        {positions.value.map(({ name }) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
      {field(0, words.ends[0])}
      {field(1, words.ends[1])}
    </>
  );
}
