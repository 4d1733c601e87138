// The properties of the whole case: title, gravity, parameters, analyses, and its contents.
import { useState } from "preact/hooks";
import { GROUPS } from "../catalogue/catalogue";
import { entries } from "../catalogue/tree";
import type { Tree } from "../core/protocol";
import { isName, rename } from "../edit/commands";
import { written, writtenList } from "../edit/values";
import { Editor } from "../exercise/Editor";
import { report } from "../store/session";
import { announce, catalogue, mechanism, tree } from "../store/state";
import { texts } from "../texts";
import { Backdrop } from "./Backdrop";
import { Contents } from "./Contents";
import { Field, put, putTyped } from "./Field";
import { Mobility } from "./Mobility";
import { Button, Section } from "./parts";
import { Ready } from "./Ready";
import { Sliders } from "./Slopes";
import { Start } from "./Start";
import { TextField } from "./TextField";

export function Case() {
  const words = texts.properties;
  const found = tree.value ?? {};
  const empty = (mechanism.value?.bodies.length ?? 0) < 2;
  return (
    <div class="properties">
      {empty ? <p class="doc">{words.nothing}</p> : null}
      <TextField label={words.title} value={written(found.title)} keep={(text) => put(["title"], text || undefined)} />
      <TextField
        label={words.gravity}
        unit="m/s²"
        value={writtenList(found.gravity)}
        placeholder="0, 0"
        keep={(text) => void putTyped(["gravity"], text, true).catch(report)}
      />
      <Parameters />
      {GROUPS.map((group) => (
        <Contents key={group} group={group} />
      ))}
      <Start />
      <Analyses />
      <Editor />
      <Mobility />
      <Ready />
      <Backdrop />
    </div>
  );
}

function Parameters() {
  const words = texts.properties;
  const [adding, setAdding] = useState("");
  const rows = Object.entries(entries(tree.value, "parameters") as unknown as Tree);
  const add = () => {
    const name = adding.trim();
    if (!isName(name, "parameters")) return announce("problem", texts.edit.invalidName(name));
    setAdding("");
    put(["parameters", name], 1);
  };
  return (
    <Section title={words.parameters}>
      {rows.map(([name, value]) => (
        <TextField
          key={name}
          label={name}
          value={written(value)}
          keep={(text) => void putTyped(["parameters", name], text).catch(report)}
          onRemove={() => put(["parameters", name], undefined)}
        />
      ))}
      <Sliders />
      <form
        class="adding"
        onSubmit={(event) => {
          event.preventDefault();
          add();
        }}
      >
        <input
          type="text"
          aria-label={words.parameterName}
          placeholder={words.parameterName}
          value={adding}
          autocomplete="off"
          onInput={(event) => setAdding(event.currentTarget.value)}
        />
        <Button label={words.addParameter} icon="plus" onClick={add} disabled={!adding.trim()} />
      </form>
    </Section>
  );
}

function Analyses() {
  const words = texts.properties;
  const all = Object.entries(entries(tree.value, "analyses"));
  const types = catalogue.value.analyses;
  const first = types[0];
  return (
    <Section
      title={words.analyses}
      action={
        first ? (
          <Button
            label={words.addAnalysis}
            icon="plus"
            kind="small"
            onClick={() => put(["analyses", `run${all.length + 1}`], { type: first.name, t_end: 5, output_step: 0.01 })}
          />
        ) : null
      }
    >
      {all.map(([name, value]) => (
        <details key={name}>
          <summary>
            <bdi>{name}</bdi> <span class="unit">{written(value.type)}</span>
          </summary>
          <TextField label={words.name} value={name} keep={(text) => void rename("analyses", name, text.trim())} />
          {types
            .find((type) => type.name === value.type)
            ?.fields.map((field) => (
              <Field key={field.name} field={field} path={["analyses", name, field.name]} value={value[field.name]} />
            ))}
        </details>
      ))}
    </Section>
  );
}
