// One field of an entry: its name, unit, value and description.
import { useId } from "preact/hooks";
import { defaultText, type Field as FieldOf } from "../catalogue/catalogue";
import { entries, isTable } from "../catalogue/tree";
import type { Path, Value } from "../core/protocol";
import { readable } from "../draw/numbers";
import { isList, isSingle, typed, typedList, written, writtenList } from "../edit/values";
import { change } from "../store/document";
import { mechanism, problems, tree } from "../store/state";
import { texts } from "../texts";

/** Put a value at a place of the case, or remove what is there. */
export function put(path: Path, value: Value | undefined): void {
  void change([value === undefined ? { path, remove: true } : { path, value }]);
}

export function Field({ field, path, value }: { field: FieldOf; path: Path; value: Value | undefined }) {
  const id = useId();
  const problem = problems.value.find((one) => one.path === path.join("."));
  const missing = field.required && value === undefined;
  return (
    <div class={`field${problem || missing ? " wrong" : ""}`}>
      <label for={id} title={field.doc}>
        {field.name}
      </label>
      <Control id={id} field={field} path={path} value={value} />
      <span class="unit">{readable(field.unit)}</span>
      {problem ? <p class="problem">{problem.message}</p> : null}
    </div>
  );
}

interface ControlProps {
  id: string;
  field: FieldOf;
  path: Path;
  value: Value | undefined;
}

function Control({ id, field, path, value }: ControlProps) {
  const { shape } = field;
  if (shape === "flag") {
    return (
      <input
        id={id}
        type="checkbox"
        checked={value === true}
        onChange={(event) => put(path, event.currentTarget.checked)}
      />
    );
  }
  const choices = choicesOf(field);
  if (choices) return <Choice id={id} field={field} path={path} value={value} choices={choices} />;
  if (isList(field))
    return <Line id={id} field={field} shown={writtenList(value)} keep={(text) => put(path, typedList(text))} />;
  if (isSingle(field))
    return <Line id={id} field={field} shown={written(value)} keep={(text) => put(path, typed(text))} />;
  return <Line id={id} field={field} shown={written(value)} keep={() => {}} fixed />;
}

function Line({
  id,
  field,
  shown,
  keep,
  fixed,
}: {
  id: string;
  field: FieldOf;
  shown: string;
  keep(text: string): void;
  fixed?: boolean;
}) {
  const empty = field.required ? texts.properties.required : defaultText(field) || texts.properties.absent;
  return (
    <input
      id={id}
      type="text"
      autocomplete="off"
      spellcheck={false}
      value={shown}
      placeholder={empty}
      title={fixed ? `${shown}\n${field.doc}` : field.doc}
      readOnly={fixed ?? false}
      onChange={(event) => {
        if (event.currentTarget.value !== shown) keep(event.currentTarget.value);
      }}
    />
  );
}

function Choice({ id, field, path, value, choices }: ControlProps & { choices: string[] }) {
  const all = typeof value === "string" && !choices.includes(value) ? [value, ...choices] : choices;
  return (
    <select
      id={id}
      title={field.doc}
      value={written(value)}
      onChange={(event) => put(path, event.currentTarget.value || undefined)}
    >
      {field.required ? null : <option value="">{defaultText(field) || texts.properties.absent}</option>}
      {field.required && value === undefined ? <option value="">{texts.properties.required}</option> : null}
      {all.map((one) => (
        <option key={one} value={one}>
          {one}
        </option>
      ))}
    </select>
  );
}

/** What a field may refer to, or its words; null for free values. */
function choicesOf({ shape }: FieldOf): string[] | null {
  if (typeof shape === "object") return "words" in shape ? shape.words : null;
  const bodies = mechanism.value?.bodies ?? [];
  if (shape === "body") return bodies.map(({ name }) => name);
  if (shape === "point")
    return bodies.flatMap(({ name, points }) => Object.keys(points).map((point) => `${name}.${point}`));
  if (shape === "joint") return Object.keys(entries(tree.value, "joints"));
  if (shape !== "curve") return null;
  return Object.entries(entries(tree.value, "bodies")).flatMap(([name, body]) =>
    isTable(body.curves) ? Object.keys(body.curves).map((curve) => `${name}.${curve}`) : [],
  );
}
