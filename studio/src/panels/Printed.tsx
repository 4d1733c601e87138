// One page of paper: title, drawing, parameters, lengths, link. It is printed while the dialog that shares is open.
import { useMemo } from "preact/hooks";
import { displayed } from "../draw/display";
import { withUnit } from "../draw/numbers";
import { codeOf } from "../give/code";
import { linkOf, MOST_OF_LINK } from "../give/link";
import { drawingSvg } from "../give/pictures";
import { distance } from "../plane/points";
import { dialog, mechanism, text, title, units } from "../store/state";
import { texts } from "../texts";
import { Code } from "./Code";

/** Rows that have room beside the drawing. */
const MOST_ROWS = 45;
/** A longer link is not printed in letters, because nobody types it. */
const MOST_LETTERS = 600;

export function Printed() {
  return dialog.value === "share" ? <Paper /> : null;
}

function Paper() {
  const words = texts.share;
  const link = useMemo(() => linkOf(text.value), [text.value]);
  const code = useMemo(() => codeOf(link), [link]);
  const picture = useMemo(drawingSvg, []);
  const rows = [...parameters(), ...lengths()];
  const more = rows.length - MOST_ROWS;
  return (
    <section class="printed">
      <h1 dir="auto">{title.value || texts.untitled}</h1>
      <img src={`data:image/svg+xml,${encodeURIComponent(picture)}`} alt={texts.sheet.label(title.value)} />
      <dl>
        {rows.slice(0, MOST_ROWS).map(([name, value]) => (
          <div key={name}>
            <dt dir="auto">{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      {more > 0 ? <p>{words.moreRows(more)}</p> : null}
      {link.length <= MOST_OF_LINK ? (
        <footer>
          {code ? <Code code={code} /> : null}
          <a href={link}>{link.length <= MOST_LETTERS ? link : words.open}</a>
        </footer>
      ) : null}
    </section>
  );
}

/** A value in the units of the display. */
function written(value: number, unit: string): string {
  const shown = displayed(unit, units.value);
  return withUnit(value * shown.factor, shown.unit);
}

function parameters(): [string, string][] {
  return (mechanism.value?.parameters ?? []).map(({ name, value, unit }) => [name, written(value, unit ?? "")]);
}

/** The distances between successive points of each body. */
function lengths(): [string, string][] {
  return (mechanism.value?.bodies ?? []).flatMap(({ name, points }) => {
    const all = Object.entries(points);
    return all.slice(1).map(([end, at], k): [string, string] => {
      const [begin, from] = all[k]!;
      return [`${name} ${begin}–${end}`, written(distance(from, at), "m")];
    });
  });
}
