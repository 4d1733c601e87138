// The questions of a case as fields, for lecturers.
import { entries, isTable } from "../catalogue/tree";
import type { Change, Tree, Value } from "../core/protocol";
import { typed, written } from "../edit/values";
import { put } from "../panels/Field";
import { Button, Section } from "../panels/parts";
import { TextField } from "../panels/TextField";
import { change } from "../store/document";
import { mechanism, tree } from "../store/state";
import { texts } from "../texts";

/** Keys of a question; those of the answer exclude each other, and the last ones may be numbers. */
const KEYS = ["text", "hints", "measure", "quantity", "unit", "at", "tolerance", "points"] as const;
type Key = (typeof KEYS)[number];
const ANSWERS: readonly Key[] = ["measure", "quantity"];

export function Editor() {
  const words = texts.exercise;
  const section = isTable(tree.value?.exercise) ? tree.value.exercise : {};
  const all = Object.entries(entries(section as Tree, "questions"));
  const quantity = mechanism.value?.coordinates[0];
  const add = () => {
    let k = all.length + 1;
    while (all.some(([name]) => name === `q${k}`)) k += 1;
    put(["exercise", "questions", `q${k}`], { text: words.newText, quantity: quantity! });
  };
  const action = quantity ? (
    <Button label={words.add} icon="plus" kind="small" onClick={add} id="add-question" />
  ) : null;
  return (
    <Section title={words.title} action={action}>
      {all.length ? (
        <TextField
          label={words.introduction}
          value={written(section.text)}
          keep={(text) => put(["exercise", "text"], text || undefined)}
        />
      ) : null}
      {all.map(([name, question]) => (
        <details key={name}>
          <summary>
            <bdi>{name}</bdi>
          </summary>
          {KEYS.map((key) => (
            <TextField
              key={key}
              label={`${name}: ${words.keys[key]}`}
              value={key === "hints" ? [question[key] ?? []].flat().join(" | ") : written(question[key])}
              keep={(text) => keep(name, key, text.trim(), question as Tree)}
            />
          ))}
          <Button
            label={words.remove(name)}
            onClick={() => put(all.length > 1 ? ["exercise", "questions", name] : ["exercise"], undefined)}
          />
        </details>
      ))}
    </Section>
  );
}

function keep(name: string, key: Key, text: string, question: Tree): void {
  const path = ["exercise", "questions", name];
  let value: Value | undefined = KEYS.indexOf(key) > 4 ? typed(text) : text;
  if (key === "hints") value = text.split("|").flatMap((one) => one.trim() || []);
  const to: Change =
    text && value !== undefined ? { path: [...path, key], value } : { path: [...path, key], remove: true };
  const others =
    ANSWERS.includes(key) && text ? ANSWERS.filter((one) => one !== key && question[one] !== undefined) : [];
  void change([to, ...others.map((one): Change => ({ path: [...path, one], remove: true }))]);
}
