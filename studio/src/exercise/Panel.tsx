// The questions of a case with their answers.
import { useState } from "preact/hooks";
import type { Question } from "../core/protocol";
import { readable } from "../draw/numbers";
import { Button, Section } from "../panels/parts";
import { texts } from "../texts";
import {
  another,
  answerTo,
  check,
  checking,
  choose,
  exercise,
  fault,
  pointsOf,
  saveResult,
  showHint,
  student,
} from "./questions";

export function ExercisePanel() {
  const words = texts.exercise;
  const found = exercise.value;
  if (!found)
    return (
      <div class="properties">
        <p class="doc wrong" role="alert">
          {fault.value ?? ""}
        </p>
      </div>
    );
  const { right, most } = pointsOf(found.questions);
  return (
    <div class="properties exercise">
      {found.text ? <p class="task">{found.text}</p> : null}
      {found.random ? <Variant seed={found.seed} key={found.seed} /> : null}
      {found.questions.map((one, k) => (
        <Asked key={`${found.seed} ${one.name}`} one={one} number={k + 1} />
      ))}
      <Section title={words.result}>
        <p class="doc" id="score" role="status">
          {words.score(right, most)}
        </p>
        <div class="field">
          <label for="student">{words.name}</label>
          <input
            id="student"
            type="text"
            autocomplete="name"
            value={student.value}
            onInput={(event) => (student.value = event.currentTarget.value)}
          />
          <span class="unit" />
        </div>
        <Button label={words.save} hint={words.saveHint} onClick={saveResult} id="save-result" kind="main" />
      </Section>
    </div>
  );
}

function Variant({ seed }: { seed: number }) {
  const words = texts.exercise;
  return (
    <div class="field">
      <label for="variant">{words.variant}</label>
      <input
        id="variant"
        type="text"
        inputMode="numeric"
        autocomplete="off"
        value={seed || ""}
        placeholder={words.ofFile}
        onChange={(event) => void choose(Number(event.currentTarget.value))}
      />
      <Button label={words.another} onClick={another} kind="small wide" id="another-variant" />
    </div>
  );
}

function Asked({ one, number }: { one: Question; number: number }) {
  const words = texts.exercise;
  const { given, right, tries, hints, fault: wrong } = answerTo(one.name);
  const [typed, setTyped] = useState(given);
  const busy = checking.value === one.name;
  const id = `answer-${one.name}`;
  const state = wrong ? wrong : right === null ? "" : right ? words.right : words.wrong(tries);
  return (
    <Section title={words.number(number, one.points)}>
      <label for={id} class="question">
        {one.text}
      </label>
      <div class="answer">
        <input
          id={id}
          type="text"
          autocomplete="off"
          spellcheck={false}
          value={typed}
          onInput={(event) => setTyped(event.currentTarget.value)}
          onKeyDown={(event) => event.key === "Enter" && void check(one.name, event.currentTarget.value)}
        />
        <span class="unit">{one.unit === "1" ? "" : readable(one.unit)}</span>
        <Button
          label={busy ? words.checking : words.check}
          onClick={() => void check(one.name, typed)}
          disabled={busy || !typed.trim()}
          id={`check-${one.name}`}
        />
      </div>
      <p class={right ? "doc right" : "doc wrong"} role="status" id={`state-${one.name}`}>
        {state}
      </p>
      {one.hints.slice(0, hints).map((hint) => (
        <p class="doc hint-text" key={hint}>
          {hint}
        </p>
      ))}
      {hints < one.hints.length && !right ? (
        <Button
          label={words.hint(hints + 1, one.hints.length)}
          onClick={() => showHint(one.name)}
          id={`hint-${one.name}`}
        />
      ) : null}
    </Section>
  );
}
