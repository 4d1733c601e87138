// The panel of read mode: runs, plots, arrows, files.
import { useState } from "preact/hooks";
import { typed } from "../edit/values";
import { savePlots } from "../give/plots";
import { openStored, saveCsv, saveNpz } from "../give/results";
import { OVER } from "../modes/over";
import { hasOtherAxis } from "../modes/plotting";
import {
  analyses,
  analysis,
  chosen,
  condition,
  course,
  found,
  notUnique,
  quantities,
  remarks,
  run,
  running,
  sharedLoads,
  variable,
} from "../modes/read";
import { arrows, KINDS, type Kind, onBody } from "../page/motionOverlay";
import { plots, stored } from "../store/plots";
import { mechanism } from "../store/state";
import { texts } from "../texts";
import { Diagram } from "./Diagram";
import { Findings } from "./Findings";
import { Measures } from "./Measures";
import { OverFields } from "./OverFields";
import { PlotCard } from "./Plot";
import { Button, Check, Section } from "./parts";

export function ReadPanel() {
  const words = texts.read;
  return (
    <div class="results">
      <RunBar />
      <Remarks />
      {course.value ? (
        <>
          <div class="chips">
            {(Object.keys(KINDS) as Kind[]).map((kind) => (
              <Check
                key={kind}
                label={words.arrows[kind]}
                checked={arrows.value[kind]}
                onChange={(on) => (arrows.value = { ...arrows.value, [kind]: on })}
              />
            ))}
            <OnBody />
          </div>
          <Section
            title={words.plots}
            action={
              <span class="buttons">
                <Button label={words.compare} hint={words.compareHint} kind="small" onClick={openStored} id="compare" />
                <Button label={words.csvHint} kind="small" onClick={() => void saveCsv()}>
                  {texts.files.csv}
                </Button>
                <Button label={words.npzHint} kind="small" onClick={() => void saveNpz()}>
                  {texts.files.npz}
                </Button>
                <Button label={words.pngHint} kind="small" spoken onClick={() => savePlots("png")}>
                  {texts.files.png}
                </Button>
                <Button label={words.svgHint} kind="small" spoken onClick={() => savePlots("svg")}>
                  {texts.files.svg}
                </Button>
              </span>
            }
          >
            <Compared />
            {notUnique.value.length ? (
              <p class="doc" id="not-unique">
                {words.notUnique(notUnique.value)}
              </p>
            ) : null}
            {sharedLoads.value.length ? (
              <p class="doc" id="shared">
                {words.shared(sharedLoads.value)}
              </p>
            ) : null}
            {condition.value ? (
              <p class="doc" id="condition">
                {words.overNote(variable.value.name, condition.value)}
              </p>
            ) : null}
            {plots.value.map((one) => (
              <PlotCard key={one.key} plot={one} />
            ))}
            <Add />
          </Section>
          <Diagram />
          <Measures />
        </>
      ) : found.value ? (
        <Findings />
      ) : (
        <p class="doc">{running.value ? words.running : words.none}</p>
      )}
    </div>
  );
}

/** Remarks on the result, which the user must see. */
function Remarks() {
  if (!remarks.value.length) return null;
  return (
    <ul class="remarks" id="remarks">
      {remarks.value.map((one) => (
        <li key={one}>{one}</li>
      ))}
    </ul>
  );
}

/** The choice of the body whose arrows are shown. */
function OnBody() {
  const names = (mechanism.value?.bodies ?? []).map(({ name }) => name);
  const chosen = names.includes(onBody.value) ? onBody.value : "";
  return (
    <label class="choice">
      <span>{texts.read.onBody}</span>
      <select id="on-body" value={chosen} onChange={(event) => (onBody.value = event.currentTarget.value)}>
        <option value="">{texts.read.onAll}</option>
        {names.map((name) => (
          <option key={name} value={name}>
            {name}
          </option>
        ))}
      </select>
    </label>
  );
}

/** The name of the compared run, and a note if it is over another variable. */
function Compared() {
  const found = stored.value;
  if (!found) return null;
  const words = texts.read;
  return (
    <>
      <p class="stored">
        <bdi>{`${words.stored}: ${found.file}`}</bdi>
        <Button
          label={words.endComparison(found.file)}
          icon="close"
          kind="small"
          onClick={() => (stored.value = null)}
        />
      </p>
      {hasOtherAxis.value ? (
        <p class="doc" id="other-axis">
          {words.otherAxis(found.variable.name, variable.value.name, found.rows.has(variable.value.name))}
        </p>
      ) : null}
    </>
  );
}

function RunBar() {
  const words = texts.read;
  const [end, setEnd] = useState("");
  const free = analysis.value === "";
  return (
    <form
      class="buttons runbar"
      onSubmit={(event) => {
        event.preventDefault();
        const until = Number(typed(end));
        void run(free && until > 0 ? until : undefined);
      }}
    >
      <label class="choice">
        <span>{words.analysis}</span>
        <select id="analysis" value={analysis.value} onChange={(event) => (chosen.value = event.currentTarget.value)}>
          {analyses.value.map(({ name, type }) => (
            <option key={name} value={name}>{`${name} (${type.replaceAll("_", " ")})`}</option>
          ))}
          <option value={OVER}>{words.over}</option>
          <option value="">{words.defaults}</option>
        </select>
      </label>
      {analysis.value === OVER ? <OverFields /> : null}
      {free ? (
        <label class="choice">
          <span>{words.end}</span>
          <input
            type="text"
            inputMode="decimal"
            size={5}
            placeholder="5"
            value={end}
            autocomplete="off"
            onInput={(event) => setEnd(event.currentTarget.value)}
          />
        </label>
      ) : null}
      <button type="submit" class="main" id="run" disabled={running.value}>
        {running.value ? words.running : words.run}
      </button>
    </form>
  );
}

function Add() {
  const groups = [...new Set(quantities.value.map(({ name }) => ownerOf(name)))];
  return (
    <select
      class="wide"
      aria-label={texts.read.addPlot}
      value=""
      onChange={(event) => {
        const name = event.currentTarget.value;
        if (name) plots.value = [...plots.value, { key: Date.now(), names: [name] }];
        event.currentTarget.value = "";
      }}
    >
      <option value="">{texts.read.addPlot}</option>
      {groups.map((group) => (
        <optgroup key={group} label={group}>
          {quantities.value
            .filter(({ name }) => ownerOf(name) === group)
            .map(({ name }) => (
              <option key={name} value={name}>
                {name}
              </option>
            ))}
        </optgroup>
      ))}
    </select>
  );
}

/** The first part of the name of a quantity: its body or element. Measures and transmission angles have none. */
function ownerOf(name: string): string {
  return name.includes(".") ? name.split(".")[0]! : texts.read.others;
}
