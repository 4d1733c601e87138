// The panel of design mode: the poses, the limits, and the candidates with their defects.
import type { Candidate, Triple } from "../core/protocol";
import { displayed } from "../draw/display";
import { besideUnit, minus, significant } from "../draw/numbers";
import { typed } from "../edit/values";
import { enter } from "../modes/modes";
import { Button, Check, Facts, Section } from "../panels/parts";
import { change } from "../store/document";
import { units } from "../store/state";
import { texts } from "../texts";
import { addBeside } from "./handler";
import { take } from "./take";
import {
  active,
  candidate,
  chosen,
  fault,
  MOST,
  posed,
  poses,
  removePose,
  rowOf,
  section,
  setOption,
  solved,
  taken,
  written,
} from "./task";

export function DesignPanel() {
  const words = texts.design;
  return (
    <div class="properties poses-panel">
      <p class="doc">{poses.value.length ? words.hint : words.begin}</p>
      {fault.value ? (
        <p class="doc wrong" role="alert">
          {fault.value}
        </p>
      ) : null}
      <Poses />
      {section.value ? <Limits /> : null}
      {solved.value ? <Candidates /> : null}
    </div>
  );
}

function Poses() {
  const words = texts.design;
  const { length } = units.value;
  return (
    <Section title={words.poses}>
      {poses.value.length ? (
        <div class="pose-head" aria-hidden="true">
          <span />
          <span>x / {length}</span>
          <span>y / {length}</span>
          <span>{words.angle(displayed("rad", units.value).unit)}</span>
        </div>
      ) : null}
      {poses.value.map((pose, k) => (
        <div class={k === active.value ? "pose-row chosen" : "pose-row"} key={k}>
          <Button label={String(k + 1)} hint={words.pose(k + 1)} onClick={() => (active.value = k)} spoken />
          {pose.map((value, j) => (
            <PoseField key={j} k={k} j={j} value={value} />
          ))}
          <Button label={words.remove(k + 1)} icon="close" kind="small" onClick={() => void removePose(k)} />
        </div>
      ))}
      <Button label={words.add} onClick={addBeside} disabled={poses.value.length >= MOST} id="add-pose" />
    </Section>
  );
}

/** A typed number of a pose, in the unit of the display; other units are written with the number. */
function PoseField({ k, j, value }: { k: number; j: number; value: number }) {
  const { factor } = displayed(j < 2 ? "m" : "rad", units.value);
  const shown = String(Number((value * factor).toPrecision(9)));
  const keep = (text: string) => {
    const given = typed(text);
    if (given === undefined) return;
    const own: Triple = [...poses.value[k]!];
    const row = rowOf(k);
    if (typeof given === "number") {
      own[j] = given / factor;
      row[j] = written(own)[j]!;
    } else row[j] = given;
    void change(posed(k, row));
  };
  return (
    <input
      type="text"
      autocomplete="off"
      spellcheck={false}
      id={`pose-${k + 1}-${"xya"[j]}`}
      aria-label={texts.design.field(k + 1, ["x", "y", texts.properties.angle][j]!)}
      value={shown}
      onFocus={() => (active.value = k)}
      onChange={(event) => event.currentTarget.value !== shown && keep(event.currentTarget.value)}
    />
  );
}

function Limits() {
  const words = texts.design;
  const own = section.value!;
  const angle = own.transmission_angle;
  const set = (text: string) => {
    const given = typed(text);
    const plain = typeof given === "number";
    setOption("transmission_angle", plain && units.value.degrees ? `${given} deg` : given);
  };
  return (
    <Section title={words.limits}>
      <Check
        label={words.tell}
        hint={words.tellHint}
        checked={own.defects === "tell"}
        onChange={(on) => setOption("defects", on ? "tell" : undefined)}
      />
      <Check
        label={words.grashof}
        hint={words.grashofHint}
        checked={own.grashof === true}
        onChange={(on) => setOption("grashof", on || undefined)}
      />
      <div class="field">
        <label for="least-transmission" title={words.transmissionHint}>
          {words.transmission}
        </label>
        <input
          id="least-transmission"
          type="text"
          autocomplete="off"
          value={angle === undefined ? "" : String(angle)}
          title={words.transmissionHint}
          placeholder={words.none}
          onChange={(event) => set(event.currentTarget.value)}
        />
        <span class="unit">{displayed("rad", units.value).unit}</span>
      </div>
    </Section>
  );
}

function Candidates() {
  const words = texts.design;
  const found = solved.value!;
  const count = found.candidates.length;
  const one = candidate.value;
  const left = found.excluded.map(({ kind, count: n }) => words.excluded(kind, n)).join(", ");
  return (
    <Section title={words.candidates(count, found.complete)}>
      {found.refused ? (
        <p class="doc" role="status">
          {found.refused.message}
          {found.refused.hint ? `; ${found.refused.hint}` : ""}
        </p>
      ) : null}
      {one ? (
        <>
          <label class="candidate">
            <span id="candidate-number">{words.number(chosen.value + 1, count)}</span>
            <input
              id="candidate"
              type="range"
              min={1}
              max={count}
              step={1}
              value={chosen.value + 1}
              disabled={count < 2}
              onInput={(event) => (chosen.value = Number(event.currentTarget.value) - 1)}
            />
          </label>
          <Facts rows={facts(one)} />
          <p class={one.defects.length ? "doc wrong" : "doc"} id="defects">
            {one.defects.length ? one.defects.join("; ") : words.noDefects}
          </p>
          <div class="buttons">
            <Button label={words.take} hint={words.takeHint} onClick={() => void take()} kind="main" id="take" />
            {taken.value === chosen.value ? (
              <Button label={words.run} onClick={() => enter("read")} id="run-taken" />
            ) : null}
          </div>
          {taken.value === null ? null : <p class="doc">{words.taken(taken.value + 1)}</p>}
        </>
      ) : null}
      {left ? (
        <p class="doc" id="excluded">
          {words.left(left)}
        </p>
      ) : null}
    </Section>
  );
}

function facts(one: Candidate): [string, string][] {
  const words = texts.design;
  const of = (value: number, unit: string): string => {
    const { factor, unit: name } = displayed(unit, units.value);
    return besideUnit(minus(significant(value * factor)), name);
  };
  const [crank, coupler, rocker, ground] = one.lengths;
  return [
    [words.type, one.type],
    [words.turns, one.turns ? words.fully : words.between],
    [words.least, one.transmission_angle > 0 ? of(one.transmission_angle, "rad") : words.passes],
    [words.lengths.crank, of(crank, "m")],
    [words.lengths.coupler, of(coupler, "m")],
    [words.lengths.rocker, of(rocker, "m")],
    [words.lengths.ground, of(ground, "m")],
  ];
}
