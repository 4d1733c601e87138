// The fields of a search for better numbers, its progress, and the numbers before and after.
import type { Search } from "../core/protocol";
import {
  AIMS,
  type Aim,
  aim,
  before,
  bounds,
  busy,
  cancel,
  discard,
  dismiss,
  fault,
  found,
  improve,
  limits,
  starts,
  wanted,
} from "../design/improve";
import { texts } from "../texts";
import { Button, Facts } from "./parts";
import { shown } from "./Readings";

export function Improve() {
  const words = texts.improve;
  const last = found.value;
  return (
    <>
      <p class="doc">{words.hint}</p>
      <div class="answer">
        <select
          aria-label={words.aim}
          id="aim"
          value={aim.value}
          onChange={(event) => (aim.value = event.currentTarget.value as Aim)}
        >
          {AIMS.map((one) => (
            <option key={one} value={one}>
              {words.aims[one]}
            </option>
          ))}
        </select>
        {aim.value === "target" ? (
          <input
            id="target"
            type="text"
            aria-label={words.target}
            placeholder={words.target}
            value={wanted.value}
            onInput={(event) => (wanted.value = event.currentTarget.value)}
          />
        ) : null}
      </div>
      <textarea
        id="limits"
        rows={2}
        aria-label={words.limits}
        placeholder={words.limits}
        spellcheck={false}
        value={limits.value}
        onInput={(event) => (limits.value = event.currentTarget.value)}
      />
      <div class="buttons">
        {busy.value ? (
          <Button label={words.cancel} onClick={cancel} id="cancel-improve" />
        ) : (
          <Button
            label={words.improve}
            hint={words.improveHint}
            onClick={() => void improve()}
            kind="main"
            id="improve"
          />
        )}
      </div>
      <p class={fault.value ? "doc wrong" : "doc"} role="status" id="improve-state">
        {fault.value || (last ? state(last) : "")}
      </p>
      {last ? <Comparison {...last} /> : null}
    </>
  );
}

function state({ runs, failed, ending, reason }: Search): string {
  const words = texts.improve;
  const parts = [words.runs(runs)];
  if (failed) parts.push(words.failed(failed, reason ?? ""));
  if (!busy.value) parts.push(words.endings[ending ?? "cancelled"]);
  if (starts.value > 1) parts.push(words.starts(starts.value));
  return parts.join(" ");
}

/** Part of the size of a limit within which it is reached. */
const REACHED = 1e-6;

/** The numbers before and after, the limits, and the choice between them. */
function Comparison({ label, unit, before: first, now, values, room }: Search) {
  const words = texts.improve;
  const lines = limits.value.split("\n").filter((line) => line.trim());
  const of = (value: number) => words.states[value < -REACHED ? "missed" : value < REACHED ? "reached" : "holds"];
  const rows: [string, string][] = [[label, words.change(shown(first, unit), shown(now, unit))]];
  for (const { name, value, unit: own } of before.value?.parameters ?? []) {
    const to = values[name];
    if (to === undefined) continue;
    const told = words.change(shown(value, own ?? ""), shown(to, own ?? ""));
    rows.push([name, bounds.value[name]?.includes(to) ? `${told} ${words.bound}` : told]);
  }
  room.forEach((value, k) => {
    rows.push([lines[k] ?? "", of(value)]);
  });
  return (
    <div id="improved">
      <Facts rows={rows} />
      {busy.value ? null : (
        <div class="buttons">
          <Button label={words.keep} onClick={dismiss} id="keep-improved" />
          <Button label={words.discard} hint={words.discardHint} onClick={() => void discard()} id="discard-improved" />
        </div>
      )}
    </div>
  );
}
