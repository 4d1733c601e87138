// The obstacles of each analysis of the drawn mechanism. A click leads to the element.
import { useEffect, useState } from "preact/hooks";
import { GROUPS } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import type { Readiness } from "../core/protocol";
import { plainly } from "../store/blame";
import { send } from "../store/session";
import { loads, mechanism, mobility, panel, selection, tools } from "../store/state";
import { texts } from "../texts";
import { choose } from "./Palette";
import { Section } from "./parts";

export function Ready() {
  const [found, setFound] = useState<Readiness[]>([]);
  const version = loads.value;
  useEffect(() => {
    let last = true;
    const keep = (all: Readiness[]) => last && setFound(all);
    if ((mechanism.value?.bodies.length ?? 0) > 1) {
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
        {withLimits(found).map((one) => (
          <div key={one.analysis}>
            <dt>{texts.ready.names[one.analysis] ?? one.analysis}</dt>
            <dd>{one.problem ? <Obstacle {...one.problem} /> : texts.ready.yes}</dd>
          </div>
        ))}
      </dl>
    </Section>
  );
}

/** The list with the limits of a motion. Limits need a mechanism with a single freedom, with or without a driver. */
function withLimits(found: Readiness[]): Readiness[] {
  const kinematics = found.find(({ analysis }) => analysis === "kinematics");
  const freedom = mobility.value?.degrees_of_freedom;
  if (!kinematics || freedom === undefined) return found;
  return [...found, { analysis: "limits", problem: obstacleToLimits(kinematics.problem, freedom) }];
}

function obstacleToLimits(ofKinematics: Readiness["problem"], freedom: number): Readiness["problem"] {
  if (ofKinematics && ofKinematics.path !== "drivers") return ofKinematics;
  const single = freedom === 1 || (freedom === 0 && mechanism.value!.drivers.length > 0);
  return single ? null : { message: texts.ready.notSingle(freedom), path: freedom ? "drivers" : "" };
}

function Obstacle({ message, hint, path }: NonNullable<Readiness["problem"]>) {
  const tool = toolOf(path ?? "");
  return (
    <span class="problem">
      {plainly(message)}
      {hint ? <span class="hint"> {hint}</span> : null}
      <button type="button" class="link" onClick={() => lead(path ?? "")}>
        {tool ? texts.ready.add(tool.label) : path?.includes(".") ? path : texts.ready.text}
      </button>
    </span>
  );
}

/** The tool for a missing element, whose path is only its group, such as `drivers`. */
function toolOf(path: string): Tool | undefined {
  return tools.value.find(({ group }) => group === path);
}

/** Select the element of a path such as `joints.C`, or the tool for a missing element; otherwise show the text. */
function lead(path: string): void {
  const [group, name] = path.split(".");
  const known = GROUPS.find((one) => one === group);
  const tool = toolOf(path);
  if (tool) choose(tool);
  else if (known && name) selection.value = { group: known, name };
  else panel.value = "text";
}
