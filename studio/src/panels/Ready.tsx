// What prevents each analysis of the mechanism as it is drawn; a click leads to the element.
import { useEffect, useState } from "preact/hooks";
import { GROUPS, type Group } from "../catalogue/catalogue";
import type { Readiness } from "../core/protocol";
import { send } from "../store/session";
import { loads, mechanism, panel, selection } from "../store/state";
import { texts } from "../texts";
import { Section } from "./parts";

export function Ready() {
  const [found, setFound] = useState<Readiness[]>([]);
  const version = loads.value;
  useEffect(() => {
    let last = true;
    const keep = (all: Readiness[]) => last && setFound(all);
    if (mechanism.value) {
      send("readiness", {}, "readiness").then(
        ({ ok }) => keep(ok),
        () => keep([]),
      );
    } else keep([]);
    return () => {
      last = false;
    };
  }, [version]);
  if (!found.length) return null;
  return (
    <Section title={texts.ready.title}>
      <dl class="facts" id="readiness">
        {found.map((one) => (
          <div key={one.analysis}>
            <dt>{texts.ready.names[one.analysis] ?? one.analysis}</dt>
            <dd>{one.problem ? <Obstacle {...one.problem} /> : texts.ready.yes}</dd>
          </div>
        ))}
      </dl>
    </Section>
  );
}

function Obstacle({ message, hint, path }: NonNullable<Readiness["problem"]>) {
  return (
    <span class="problem">
      {message}
      {hint ? <span class="hint"> {hint}</span> : null}
      {path?.includes(".") ? (
        <button type="button" class="link" onClick={() => lead(path)}>
          {path}
        </button>
      ) : null}
    </span>
  );
}

/** Select the element of a path such as `joints.C`; other places are shown in the text. */
function lead(path: string): void {
  const [group, name] = path.split(".");
  const known = GROUPS.find((one) => one === group) as Group | undefined;
  if (known && name) selection.value = { group: known, name };
  else panel.value = "text";
}
