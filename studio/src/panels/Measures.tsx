// Numbers of the measures of the case and of typed measures over the run.
import { useEffect, useState } from "preact/hooks";
import { entries } from "../catalogue/tree";
import { type Course, course, valuesOf } from "../modes/read";
import { tree } from "../store/state";
import { texts } from "../texts";
import { Button, Section } from "./parts";
import { shown } from "./Readings";

interface Measure {
  name: string;
  expression: string;
}

interface Numbers {
  peak: string;
  mean: string;
  final: string;
}

export function Measures() {
  const words = texts.measures;
  const [typed, setTyped] = useState<string[]>([]);
  const [text, setText] = useState("");
  const own = Object.entries(entries(tree.value, "measures")).map(([name, value]) => ({
    name,
    expression: String(value),
  }));
  const add = () => {
    const expression = text.trim();
    if (expression && !typed.includes(expression)) setTyped([...typed, expression]);
    setText("");
  };
  return (
    <Section title={words.title}>
      {own.map((one) => (
        <Row key={one.name} one={one} />
      ))}
      {typed.map((expression) => (
        <Row
          key={expression}
          one={{ name: expression, expression }}
          onRemove={() => setTyped(typed.filter((one) => one !== expression))}
        />
      ))}
      <form
        class="adding"
        onSubmit={(event) => {
          event.preventDefault();
          add();
        }}
      >
        <input
          type="text"
          aria-label={words.add}
          placeholder={words.add}
          value={text}
          autocomplete="off"
          spellcheck={false}
          onInput={(event) => setText(event.currentTarget.value)}
        />
        <Button label={words.add} icon="plus" onClick={add} disabled={!text.trim()} />
      </form>
    </Section>
  );
}

function Row({ one: { name, expression }, onRemove }: { one: Measure; onRemove?: () => void }) {
  const [found, setFound] = useState<Numbers | string>("");
  const run = course.value;
  useEffect(() => {
    let current = true;
    const show = (value: Numbers | string) => current && setFound(value);
    if (run) void numbersOf(expression, run).then(show, (error: Error) => show(error.message));
    return () => {
      current = false;
    };
  }, [expression, run]);
  const words = texts.measures;
  return (
    <div class="measure">
      <bdi class="name" title={expression}>
        {name}
      </bdi>
      {typeof found === "string" ? (
        <span class="problem">{found}</span>
      ) : (
        <span class="value">{words.numbers(found.peak, found.mean, found.final)}</span>
      )}
      {onRemove ? (
        <Button label={`${texts.properties.remove} ${name}`} icon="close" kind="small" onClick={onRemove} />
      ) : null}
    </div>
  );
}

/** Largest value, mean by the trapezoidal rule, and last value over the outputs. */
async function numbersOf(expression: string, { t }: Course): Promise<Numbers> {
  const { units, rows } = await valuesOf([expression]);
  const row = rows[0]!;
  let [peak, area] = [row[0]!, 0];
  row.forEach((value, k) => {
    if (Math.abs(value) > Math.abs(peak)) peak = value;
    if (k > 0) area += (0.5 * (value + row[k - 1]!) * (t[k]! - t[k - 1]!)) / (t.at(-1)! - t[0]!);
  });
  const unit = units[0] ?? "";
  return { peak: shown(peak, unit), mean: shown(area, unit), final: shown(row.at(-1)!, unit) };
}
