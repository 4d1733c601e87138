// The prescribed coordinates and rates of the start, and a row that adds another one.
import { useState } from "preact/hooks";
import { prescribed } from "../edit/start";
import { written } from "../edit/values";
import { report } from "../store/session";
import { mechanism, tree } from "../store/state";
import { texts } from "../texts";
import { put, putTyped } from "./Field";
import { Button, Section } from "./parts";
import { TextField } from "./TextField";

/** With more coordinates, none are suggested. */
const MOST = 60;

export function Start() {
  const set = prescribed(tree.value);
  if (!set.length && (mechanism.value?.bodies.length ?? 0) < 2) return null;
  return (
    <Section title={texts.properties.startSet}>
      {set.map(({ name, value, path }) => (
        <TextField
          key={name}
          label={name}
          value={written(value)}
          keep={(text) => void putTyped(path, text).catch(report)}
          onRemove={() => put(path, undefined)}
        />
      ))}
      <Adding />
    </Section>
  );
}

function Adding() {
  const words = texts.properties;
  const [name, setName] = useState("");
  const [value, setValue] = useState("");
  const names = mechanism.value?.coordinates ?? [];
  const given = name.trim() && value.trim();
  const add = () => {
    if (!given) return;
    const path = prescribed(tree.value).find((one) => one.name === name.trim())?.path;
    void putTyped(path ?? ["start", "set", name.trim()], value).catch(report);
    setName("");
    setValue("");
  };
  const input = (id: string, label: string, example: string, text: string, keep: (text: string) => void) => (
    <input
      type="text"
      id={id}
      list={id === "start-name" ? "start-names" : undefined}
      aria-label={label}
      placeholder={example}
      value={text}
      autocomplete="off"
      spellcheck={false}
      onInput={(event) => keep(event.currentTarget.value)}
    />
  );
  return (
    <form
      class="adding"
      onSubmit={(event) => {
        event.preventDefault();
        add();
      }}
    >
      {input("start-name", words.startName, words.startExamples[0], name, setName)}
      {input("start-value", words.startValue, words.startExamples[1], value, setValue)}
      <datalist id="start-names">
        {names.length > MOST ? null : names.map((one) => <option key={one} value={one} />)}
      </datalist>
      <Button label={words.addStart} icon="plus" onClick={add} disabled={!given} />
      <button type="submit" hidden />
    </form>
  );
}
