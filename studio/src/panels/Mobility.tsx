// Freedom of the mechanism: degrees of freedom, redundancy, Grashof's rule, the number of assembly modes.
import { useEffect, useState } from "preact/hooks";
import { isPin } from "../catalogue/catalogue";
import { enter } from "../modes/modes";
import { findConfigurations } from "../modes/move";
import { send } from "../store/session";
import { catalogue, loads, mechanism, mobility, mode, text, unassembled } from "../store/state";
import { texts } from "../texts";
import { Button, Facts, Section } from "./parts";

/** Modes are counted after this time without changes, ms. */
const PAUSE = 300;
/** The largest number of bodies for which modes are counted, and the largest number of modes. */
const MOST_BODIES = 12;
const MOST_MODES = 24;
/** The largest number of listed four-bar loops. */
const MOST_LOOPS = 8;
/** The text whose modes could not be counted. They are not counted again after a restart of the core. */
let uncounted: string | null = null;

export function Mobility() {
  const found = mobility.value;
  const words = texts.move;
  if (!found || (mechanism.value?.bodies.length ?? 0) < 2) return null;
  const rows: [string, string][] = [
    [words.freedom, String(found.degrees_of_freedom)],
    [words.redundant, String(found.redundant.length)],
    [words.gruebler, String(found.gruebler)],
    [words.rank, String(found.rank)],
  ];
  return (
    <Section title={words.mobility}>
      <Facts rows={rows} />
      {found.four_bars.slice(0, MOST_LOOPS).map(({ pins, kind, turning }) => (
        <p class="doc" key={pins.join()}>
          {words.fourBar(pins.join("-"), kind, (turning ?? []).join(", "))}
        </p>
      ))}
      {found.four_bars.length > MOST_LOOPS ? (
        <p class="doc">{words.moreLoops(found.four_bars.length - MOST_LOOPS)}</p>
      ) : null}
      {mode.value === "edit" ? <Modes /> : null}
    </Section>
  );
}

/** The number of assembly modes, if it can be found quickly, and a link to them. */
function Modes() {
  const [count, setCount] = useState<string | null>(null);
  const version = loads.value;
  useEffect(() => {
    let current = true;
    const keep = (found: string | null) => current && setCount(found);
    const timer = setTimeout(() => {
      const given = text.value;
      if (!isCounted() || given === uncounted) return keep(null);
      send("configurations", { limit: MOST_MODES }, "count").then(
        ({ ok }) => keep(texts.move.count(ok.poses.length, ok.complete)),
        () => {
          uncounted = given;
          keep(null);
        },
      );
    }, PAUSE);
    return () => {
      current = false;
      clearTimeout(timer);
    };
  }, [version]);
  const show = () => {
    enter("move");
    void findConfigurations();
  };
  return (
    <>
      {count === null ? null : <Facts rows={[[texts.move.configurations, count]]} />}
      <Button label={texts.move.find} onClick={show} id="show-configurations" />
    </>
  );
}

/** Whether modes are found quickly: all joints are pins, and the bodies are few. */
function isCounted(): boolean {
  const found = mechanism.value;
  const pins = new Set(catalogue.value.joints.filter(isPin).map(({ name }) => name));
  const few = found !== null && found.bodies.length <= MOST_BODIES + 1;
  return few && !unassembled.value && found.joints.every(({ type }) => pins.has(type));
}
