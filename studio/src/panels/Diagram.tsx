// A diagram of the shown output: instantaneous centres, a polygon, or a body with all loads on it.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { drawnSides, nameOf, paintFreeBody, paintPolygon } from "../diagrams/painting";
import { size } from "../diagrams/points";
import { centres, freeBody, freeNumber, from, instant, polygon, unitOf } from "../diagrams/shown";
import { LENGTHS } from "../draw/display";
import { significant } from "../draw/numbers";
import { soon } from "../draw/soon";
import { cleared, palette, sharpen } from "../draw/surface";
import { starred, variable } from "../modes/read";
import type { Point } from "../plane/points";
import { DIAGRAMS, diagram, type Diagram as Kind, ofBody, withBody } from "../store/diagram";
import { items, mechanism, poses, units } from "../store/state";
import { texts } from "../texts";
import { Facts, Section } from "./parts";
import { shown } from "./Readings";

export function Diagram() {
  const words = texts.read;
  const kind = diagram.value;
  const at = instant.value;
  return (
    <Section title={words.diagram}>
      <div class="choices">
        <select
          id="diagram"
          aria-label={words.diagram}
          value={kind}
          onChange={(event) => (diagram.value = event.currentTarget.value as Kind)}
        >
          {DIAGRAMS.map((one) => (
            <option key={one} value={one}>
              {words.diagrams[one]}
            </option>
          ))}
        </select>
        <Bodies kind={kind} />
      </div>
      {kind === "none" || !at ? null : (
        <>
          {kind === "centres" ? null : <Picture />}
          <p class="doc">{words.instant(variable.value.name, shown(at.t, variable.value.unit))}</p>
          <Values kind={kind} />
        </>
      )}
    </Section>
  );
}

/** The choice of the body of a free-body diagram, or of the pair whose centres and centrodes are shown. */
function Bodies({ kind }: { kind: Kind }) {
  const words = texts.read;
  const all = (mechanism.value?.bodies ?? []).map(({ name }, number) => ({ name, number }));
  if (kind === "body")
    return (
      <Choice
        id="of-body"
        label={words.diagrams.body}
        value={all[freeNumber.value]?.name ?? ""}
        of={ofBody}
        names={all.slice(1)}
      />
    );
  if (kind !== "centres") return null;
  const seen = all[from.value ?? -1]?.name ?? "";
  const others = all.filter(({ number }) => number !== (from.value ?? 0));
  return (
    <>
      <Choice id="of-body" label={words.seenFrom} value={seen} of={ofBody} names={all} none={words.allPairs} />
      <Choice
        id="with-body"
        label={words.centrodes}
        value={withBody.value}
        of={withBody}
        names={others}
        none={words.noCentrodes}
      />
    </>
  );
}

interface ChoiceProps {
  id: string;
  label: string;
  value: string;
  of: { value: string };
  names: { name: string; number: number }[];
  none?: string;
}

function Choice({ id, label, value, of, names, none }: ChoiceProps) {
  return (
    <select
      id={id}
      aria-label={label}
      title={label}
      value={value}
      onChange={(event) => (of.value = event.currentTarget.value)}
    >
      {none ? <option value="">{none}</option> : null}
      {names.map(({ name, number }) => (
        <option key={name} value={name}>
          {`${number} ${name}`}
        </option>
      ))}
    </select>
  );
}

function Picture() {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => {
    const paint = soon(() => canvas.current && paintOn(canvas.current));
    const stop = effect(() => {
      for (const one of [instant, polygon, freeBody, items, units]) one.value;
      paint();
    });
    const dark = matchMedia("(prefers-color-scheme: dark)");
    dark.addEventListener("change", paint);
    const observer = new ResizeObserver(paint);
    observer.observe(canvas.current!);
    return () => {
      stop();
      observer.disconnect();
      dark.removeEventListener("change", paint);
    };
  }, []);
  return <canvas ref={canvas} class="diagram" role="img" aria-label={texts.read.diagrams[diagram.value]} />;
}

function paintOn(canvas: HTMLCanvasElement): void {
  sharpen(canvas);
  const context = cleared(canvas);
  const { width, height } = canvas.getBoundingClientRect();
  const room: Point = [width, height];
  const [shape, free, number] = [polygon.value, freeBody.value, freeNumber.value];
  if (shape) {
    const fast = diagram.value === "velocity";
    const of = {
      kind: fast ? "velocities" : "accelerations",
      unit: unitOf(fast ? ".vx" : ".ax"),
      units: units.value,
    } as const;
    paintPolygon(context, shape, of, room, palette());
  }
  const body = mechanism.value?.bodies[number];
  if (!free || !body || !instant.value) return;
  const { name, points } = body;
  const drawn = { number, name, points: Object.values(points), items: items.value };
  const places = instant.value.bodies.map(({ pose }) => pose);
  paintFreeBody(context, free, { ...drawn, poses: places }, room, palette(), (of) => marked(of));
}

/** The name of a load, with a star if it is not unique. */
function marked(name: string): string {
  return name === "gravity" ? texts.read.weight : starred(name, name);
}

/** The values of the diagram as a table. */
function Values({ kind }: { kind: Kind }) {
  const words = texts.read;
  if (kind === "centres")
    return <Facts rows={centres.value.map((one) => [nameOf(one, poses.value.length), placeText(one)])} />;
  if (kind === "body") {
    const free = freeBody.value;
    if (!free) return <p class="problem">{words.noLoads}</p>;
    const rows = free.loads.map(({ name, force, moment }): [string, string] => [marked(name), loadText(force, moment)]);
    const inertia: [string, string] = ["m a, J α", loadText(free.force, free.moment)];
    return (
      <>
        <Facts rows={[...rows, inertia]} />
        <p class="doc">{words.inBalance(significant(free.error, 2))}</p>
      </>
    );
  }
  const unit = unitOf(kind === "velocity" ? ".vx" : ".ax");
  const sides = drawnSides(polygon.value?.sides ?? []);
  return (
    <Facts
      rows={sides.map(({ name, part, vector }) => [
        `${name} ${part === "absolute" ? "" : words.parts[part]}`.trim(),
        vectorText(vector, unit),
      ])}
    />
  );
}

function vectorText(vector: Point, unit: string): string {
  const length = size(vector);
  return length > 0
    ? texts.read.directed(shown(length, unit), shown(Math.atan2(vector[1], vector[0]), "rad"))
    : shown(length, unit);
}

function loadText(force: Point, moment: number): string {
  return `${vectorText(force, "N")}, ${shown(moment, "N*m")}`;
}

function placeText({ at, direction }: (typeof centres.value)[number]): string {
  if (!at) return texts.read.infinite(shown(Math.atan2(direction[1], direction[0]), "rad"));
  const { length } = units.value;
  return `${at.map((x) => significant(x * LENGTHS[length])).join("; ")} ${length}`;
}
