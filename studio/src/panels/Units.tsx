// The units of the display, for all modes.
import { LENGTHS, type Units as UnitsOf } from "../draw/display";
import { units } from "../store/state";
import { texts } from "../texts";
import { Check } from "./parts";

export function Units() {
  const words = texts.units;
  const { degrees, length } = units.value;
  return (
    <div class="units" role="group" aria-label={words.title}>
      <label class="choice" title={words.lengthHint}>
        <span>{words.length}</span>
        <select
          id="length-unit"
          value={length}
          onChange={(event) =>
            (units.value = { ...units.value, length: event.currentTarget.value as UnitsOf["length"] })
          }
        >
          {Object.keys(LENGTHS).map((one) => (
            <option key={one} value={one}>
              {one}
            </option>
          ))}
        </select>
      </label>
      <Check
        label={words.degrees}
        checked={degrees}
        onChange={(on) => (units.value = { ...units.value, degrees: on })}
      />
    </div>
  );
}
