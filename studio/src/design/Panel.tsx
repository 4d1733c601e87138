// The panel of design mode: the poses, the limits, and the candidates with their defects.
import type { Candidate, Triple } from "../core/protocol";
import { cam as camTexts } from "../designTexts";
import { displayed } from "../draw/display";
import { besideUnit, minus, significant } from "../draw/numbers";
import { typed } from "../edit/values";
import { enter } from "../modes/modes";
import { Button, Check, Facts, Section } from "../panels/parts";
import { change } from "../store/document";
import { units } from "../store/state";
import { texts } from "../texts";
import { CamPanel } from "./CamPanel";
import { cams } from "./cam";
import { addBeside } from "./handler";
import { take } from "./take";
import {
  active,
  candidate,
  choose,
  chosen,
  draws,
  fault,
  full,
  hovered,
  list,
  posed,
  poses,
  removePose,
  removeTask,
  rowOf,
  searching,
  section,
  setOption,
  single,
  solved,
  stop,
  taken,
  written,
} from "./task";

export function DesignPanel() {
  const words = texts.design;
  const begun = poses.value.length > 0;
  const told = draws.value ? (begun ? words.hintPath : words.beginPath) : begun ? words.hint : words.begin;
  const kind = (of: "poses" | "points" | "cam") => (
    <Button
      label={words.kinds[of]}
      pressed={of === "cam" ? cams.value : !cams.value && list.value === of}
      onClick={() => {
        cams.value = of === "cam";
        if (of !== "cam") draws.value = of === "points";
      }}
      id={`by-${of}`}
    />
  );
  return (
    <div class="properties poses-panel">
      <div class="buttons">
        {kind("poses")}
        {kind("points")}
        {kind("cam")}
      </div>
      <p class="doc">{cams.value ? camTexts.begin : told}</p>
      {cams.value ? <CamPanel /> : <Task />}
    </div>
  );
}

function Task() {
  return (
    <>
      {fault.value ? (
        <p class="doc wrong" role="alert">
          {fault.value}
        </p>
      ) : null}
      <Poses />
      {section.value ? <Limits /> : null}
      {solved.value ? <Candidates /> : null}
    </>
  );
}

function Poses() {
  const words = texts.design;
  const { length } = units.value;
  const [what, flat] = [words.one[list.value], draws.value ? " flat" : ""];
  if (!single.value)
    return (
      <Section title={words.poses.points}>
        <p class="doc">{words.many(poses.value.length)}</p>
        <Button label={words.removePath} onClick={() => void removeTask()} id="remove-path" />
      </Section>
    );
  return (
    <Section title={words.poses[list.value]}>
      {poses.value.length ? (
        <div class={`pose-head${flat}`} aria-hidden="true">
          <span />
          <span>x / {length}</span>
          <span>y / {length}</span>
          {flat ? null : <span>{words.angle(displayed("rad", units.value).unit)}</span>}
        </div>
      ) : null}
      {poses.value.map((pose, k) => (
        <div class={`pose-row${flat}${k === active.value ? " chosen" : ""}`} key={k}>
          <Button label={String(k + 1)} hint={words.pose(what, k + 1)} onClick={() => (active.value = k)} spoken />
          {pose.slice(0, flat ? 2 : 3).map((value, j) => (
            <PoseField key={j} k={k} j={j} value={value} />
          ))}
          <Button label={words.remove(what, k + 1)} icon="close" kind="small" onClick={() => void removePose(k)} />
        </div>
      ))}
      <Button label={words.add(what)} onClick={addBeside} disabled={full.value} id="add-pose" />
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
      aria-label={texts.design.field(texts.design.one[list.value], k + 1, ["x", "y", texts.properties.angle][j]!)}
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
      {searching.value && found.tried !== undefined ? (
        <div class="searching">
          <progress aria-label={words.searching} max={found.most} value={found.tried} />
          <Button label={words.cancel} onClick={() => void stop()} id="stop" />
        </div>
      ) : null}
      {one ? (
        <>
          {found.tried === undefined ? <Slider count={count} /> : <List all={found.candidates} />}
          <Facts rows={facts(one)} />
          <p class={one.defects.length ? "doc wrong" : "doc"} id="defects">
            {one.defects.length ? one.defects.join("; ") : words.noDefects(words.one[list.value])}
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

function Slider({ count }: { count: number }) {
  return (
    <label class="candidate">
      <span id="candidate-number">{texts.design.number(chosen.value + 1, count)}</span>
      <input
        id="candidate"
        type="range"
        min={1}
        max={count}
        step={1}
        value={chosen.value + 1}
        disabled={count < 2}
        onInput={(event) => choose(Number(event.currentTarget.value) - 1)}
      />
    </label>
  );
}

/** The four-bars of a path; the one under the pointer is shown against its points. */
function List({ all }: { all: Candidate[] }) {
  const words = texts.design;
  const { unit } = displayed("rad", units.value);
  return (
    <div class="traces" role="group" onPointerLeave={() => (hovered.value = null)}>
      <div class="trace" aria-hidden="true">
        <span title={words.errorHint}>{words.error(units.value.length)}</span>
        <span title={words.least}>{words.transmitted(unit)}</span>
        <span>{words.type}</span>
      </div>
      {all.map((one, k) => (
        <button
          type="button"
          key={k}
          class={`trace${one.defects.length ? " flawed" : ""}`}
          aria-pressed={chosen.value === k}
          onPointerEnter={(event) => {
            if (event.pointerType === "mouse") hovered.value = k;
          }}
          onClick={() => choose(k)}
        >
          <span>{number(one.error, "m")[0]}</span>
          <span>{one.transmission_angle > 0 ? number(one.transmission_angle, "rad")[0] : "–"}</span>
          <span>{[one.type, ...one.defects.map((what) => what.split(":")[0])].join(", ")}</span>
        </button>
      ))}
    </div>
  );
}

/** A number in the unit of the display, and this unit. */
function number(value: number, of: string): [string, string] {
  const { factor, unit } = displayed(of, units.value);
  return [minus(significant(value * factor)), unit];
}

function facts(one: Candidate): [string, string][] {
  const words = texts.design;
  const of = (value: number, unit: string) => besideUnit(...number(value, unit));
  const [crank, coupler, rocker, ground] = one.lengths;
  return [
    [words.type, one.type],
    ...(draws.value ? [[words.distance, of(one.error, "m")] as [string, string]] : []),
    [words.turns, one.turns ? words.fully : words.between],
    [words.least, one.transmission_angle > 0 ? of(one.transmission_angle, "rad") : words.passes],
    [words.lengths.crank, of(crank, "m")],
    [words.lengths.coupler, of(coupler, "m")],
    [words.lengths.rocker, of(rocker, "m")],
    [words.lengths.ground, of(ground, "m")],
  ];
}
