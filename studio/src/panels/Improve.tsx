// The fields of a search for better numbers, its progress, and the numbers before and after.
import type { Search } from "../core/protocol";
import {
  AIMS,
  type Aim,
  aim,
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
import { mechanism } from "../store/state";
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

/** The numbers before and after, the limits, and the choice between them. */
function Comparison({ label, unit, before, now, values, limits: all }: Search) {
  const words = texts.improve;
  const unitOf = (name: string) => mechanism.value?.parameters.find((one) => one.name === name)?.unit ?? "";
  const rows: [string, string][] = [
    [label, words.change(shown(before, unit), shown(now, unit))],
    ...values.map(({ name, before: from, now: to, reached }): [string, string] => [
      name,
      words.change(shown(from, unitOf(name)), shown(to, unitOf(name))) + (reached ? ` ${words.bound}` : ""),
    ]),
    ...all.map(({ text, state: of }): [string, string] => [text, words.states[of]]),
  ];
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
