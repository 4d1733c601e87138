// One field of an entry: its name, unit, value and description.
import { useId } from "preact/hooks";
import { defaultText, type Field as FieldOf } from "../catalogue/catalogue";
import { entries, isTable } from "../catalogue/tree";
import type { Path, Value } from "../core/protocol";
import { readable } from "../draw/numbers";
import { meantValue, notationMeant } from "../edit/meaning";
import { isList, isNotation, isSingle, typed, typedList, typeMeant, written, writtenList } from "../edit/values";
import { change } from "../store/document";
import { report } from "../store/session";
import { mechanism, problems, tree } from "../store/state";
import { texts } from "../texts";

/** A table with more characters has the whole width of the panel. */
const LINE = 18;

/** Write a value at a path of the case, or remove the value there. */
export function put(path: Path, value: Value | undefined): void {
  void change([value === undefined ? { path, remove: true } : { path, value }]);
}

/** Write a typed text at a path of the case. Tables and lists may be in the notation of the file. */
export async function putTyped(path: Path, text: string, list = false): Promise<void> {
  if (!isNotation(text, list)) return put(path, list ? typedList(text) : typed(text));
  const value = meantValue(await notationMeant(text));
  if (value !== undefined) put(path, value);
}

export function Field({ field, path, value }: { field: FieldOf; path: Path; value: Value | undefined }) {
  const id = useId();
  const place = path.join(".");
  const own = problems.value.filter((one) => one.path === place || one.path?.startsWith(`${place}.`));
  const missing = field.required && value === undefined;
  return (
    <div class={`field${own.length || missing ? " wrong" : ""}`}>
      <label for={id} title={field.doc}>
        {field.name}
      </label>
      <Control id={id} field={field} path={path} value={value} />
      <span class="unit">{field.unit !== "any" && readable(field.unit)}</span>
      {own.map(({ path: at, message }) => (
        <p key={at} class="problem">
          {message}
        </p>
      ))}
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
  const list = isList(field);
  const keep = (text: string) => {
    const chosen = typeMeant(field, text);
    if (chosen !== undefined) put(path, chosen);
    else void putTyped(path, text, list).catch(report);
  };
  const shown = list ? writtenList(value) : written(value);
  return isSingle(field) || list ? (
    <Line id={id} field={field} shown={shown} keep={keep} />
  ) : (
    <Notation id={id} field={field} shown={shown} keep={keep} />
  );
}

interface LineProps {
  id: string;
  field: FieldOf;
  shown: string;
  keep(text: string): void;
}

function placeholder(field: FieldOf): string {
  return field.required ? texts.properties.required : defaultText(field) || texts.properties.absent;
}

/** A table or a long list, in the notation of the file. Enter ends the input. */
function Notation({ id, field, shown, keep }: LineProps) {
  return (
    <textarea
      id={id}
      class={`notation${shown.length > LINE ? " wide" : ""}`}
      autocomplete="off"
      spellcheck={false}
      rows={1}
      value={shown}
      placeholder={placeholder(field)}
      title={field.doc}
      onKeyDown={(event) => {
        if (event.key === "Enter") event.preventDefault();
        if (event.key === "Enter" || event.key === "Escape") event.currentTarget.blur();
      }}
      onChange={(event) => {
        if (event.currentTarget.value !== shown) keep(event.currentTarget.value);
      }}
    />
  );
}

function Line({ id, field, shown, keep }: LineProps) {
  return (
    <input
      id={id}
      type="text"
      autocomplete="off"
      spellcheck={false}
      value={shown}
      placeholder={placeholder(field)}
      title={field.doc}
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

/** The permitted references or words of a field; null for free values. */
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
