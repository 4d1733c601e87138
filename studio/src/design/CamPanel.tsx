// The panel of a cam: its programme, the diagram of the lift, kinds and sizes, what the core finds, and what to do with it.
import { cam as camTexts } from "../designTexts";
import { displayed } from "../draw/display";
import { besideUnit, minus, significant } from "../draw/numbers";
import { enter } from "../modes/modes";
import { Button, Facts, Section } from "../panels/parts";
import { units } from "../store/state";
import { texts } from "../texts";
import { CamDiagram } from "./CamDiagram";
import {
  CLOSURES,
  DIRECTIONS,
  FOLLOWERS,
  fault,
  fill,
  found,
  isUsed,
  lack,
  MOTIONS,
  type Sizes,
  saveDrawing,
  segments,
  setSegments,
  setSizes,
  sizes,
  use,
} from "./cam";
import { LAWS, type Segment, WAYS, type Way } from "./segments";

const RADIANS = Math.PI / 180;

export function CamPanel() {
  const words = camTexts;
  const wrong = lack.value ? words.lack(lack.value) : fault.value;
  return (
    <>
      <Programme />
      {wrong ? (
        <p class="doc wrong" role="alert" id="cam-fault">
          {wrong} {lack.value ? <Button label={words.fill} onClick={fill} id="cam-fill" /> : null}
        </p>
      ) : null}
      <CamDiagram />
      <Shape />
      {found.value && !wrong ? <Result /> : null}
    </>
  );
}

function Programme() {
  const words = camTexts;
  const all = segments.value;
  const set = (k: number, next: Partial<Segment>) =>
    setSegments(all.map((one, j) => (j === k ? { ...one, ...next } : one)));
  const add = () =>
    setSegments([...all, { way: "dwell", angle: Math.max(10, lack.value), height: null, law: LAWS[0] }]);
  return (
    <Section title={words.programme}>
      {all.map((one, k) => (
        <div class="segment-row" key={k} role="group" aria-label={words.segment(k + 1)}>
          <Choice
            label={words.way(k + 1)}
            id={`segment-${k + 1}-way`}
            of={WAYS}
            words={words.ways}
            value={one.way}
            onChange={(way: Way) => set(k, { way, height: way === "rise" ? (one.height ?? defaultHeight()) : null })}
          />
          <Amount
            label={words.angle(k + 1)}
            id={`segment-${k + 1}-angle`}
            si={one.angle * RADIANS}
            unit="rad"
            keep={(x) => set(k, { angle: exact(x / RADIANS) })}
          />
          {one.way === "dwell" ? <span /> : <Height k={k} one={one} set={(height) => set(k, { height })} />}
          <Button
            label={words.remove(k + 1)}
            icon="close"
            kind="small"
            disabled={all.length < 2}
            onClick={() => setSegments(all.filter((_, j) => j !== k))}
          />
          {one.way === "dwell" ? null : (
            <Choice
              label={words.law(k + 1)}
              id={`segment-${k + 1}-law`}
              of={LAWS}
              words={words.laws}
              value={one.law}
              onChange={(law) => set(k, { law })}
            />
          )}
        </div>
      ))}
      <Button label={words.add} onClick={add} id="add-segment" />
    </Section>
  );
}

/** Without the rounding error of a conversion. */
function exact(x: number): number {
  return Number(x.toPrecision(14));
}

function defaultHeight(): number {
  return sizes.value.motion === "oscillating" ? 15 : 0.01;
}

/** The change of the lift; empty for a return to no lift. */
function Height({ k, one, set }: { k: number; one: Segment; set(height: number | null): void }) {
  const words = camTexts;
  const swings = sizes.value.motion === "oscillating";
  return (
    <Amount
      label={words.lift(k + 1)}
      id={`segment-${k + 1}-lift`}
      si={one.height === null ? null : swings ? one.height * RADIANS : one.height}
      unit={swings ? "rad" : "m"}
      empty={one.way === "return" ? words.toNone : undefined}
      keep={(x) => set(swings ? exact(x / RADIANS) : x)}
      clear={one.way === "return" ? () => set(null) : undefined}
    />
  );
}

interface ChoiceProps<T extends string> {
  label: string;
  id: string;
  of: readonly T[];
  words: Record<string, string>;
  value: string;
  onChange(value: T): void;
}

function Choice<T extends string>({ label, id, of, words, value, onChange }: ChoiceProps<T>) {
  return (
    <select id={id} aria-label={label} value={value} onChange={(event) => onChange(event.currentTarget.value as T)}>
      {of.map((one) => (
        <option value={one} key={one}>
          {words[one]}
        </option>
      ))}
    </select>
  );
}

interface AmountProps {
  label: string;
  id: string;
  si: number | null;
  unit: string;
  /** What an empty field means. */
  empty?: string | undefined;
  keep(si: number): void;
  clear?: (() => void) | undefined;
}

/** A number in the unit of the display, with this unit. */
function Amount({ label, id, si, unit, empty, keep, clear }: AmountProps) {
  const { factor, unit: shown } = displayed(unit, units.value);
  const text = si === null ? "" : String(Number((si * factor).toPrecision(9)));
  const typed = (input: HTMLInputElement) => {
    if (input.value === text) return;
    const x = Number(input.value.trim().replace(",", "."));
    if (input.value.trim() === "" && clear) clear();
    else if (input.value.trim() !== "" && Number.isFinite(x)) keep(exact(x / factor));
    else input.value = text;
  };
  return (
    <span class="sized">
      <input
        type="text"
        inputMode="decimal"
        autocomplete="off"
        spellcheck={false}
        id={id}
        aria-label={label}
        placeholder={empty}
        value={text}
        onChange={(event) => typed(event.currentTarget)}
      />
      <span class="unit">{shown}</span>
    </span>
  );
}

type Named = { [K in keyof Sizes]: Sizes[K] extends number ? K : never }[keyof Sizes];

function Size({ name, unit }: { name: Named; unit: string }) {
  const label = camTexts.sizes[name];
  return (
    <div class="field">
      <label for={`cam-${name}`}>{label}</label>
      <Amount
        label={label}
        id={`cam-${name}`}
        si={sizes.value[name]}
        unit={unit}
        keep={(x) => setSizes({ [name]: x })}
      />
    </div>
  );
}

function Shape() {
  const words = camTexts;
  const { follower, motion, closure, direction } = sizes.value;
  const swings = motion === "oscillating";
  const closures = CLOSURES.filter((one) => one !== "groove" || follower === "roller");
  const pick = <K extends "follower" | "motion" | "closure" | "direction">(
    name: K,
    of: readonly Sizes[K][],
    value: string,
  ) => (
    <Choice
      label={words.kinds[name]}
      id={`cam-${name}`}
      of={of}
      words={words[name]}
      value={value}
      onChange={(next) => setSizes({ [name]: next } as Partial<Sizes>)}
    />
  );
  const [per, torque] = swings ? ["N*m/rad", "N*m"] : ["N/m", "N"];
  return (
    <Section title={words.shape}>
      <div class="pairs">
        {pick("motion", MOTIONS, motion)}
        {pick("follower", FOLLOWERS, follower)}
        {pick("closure", closures, closure)}
        {pick("direction", DIRECTIONS, direction)}
      </div>
      <Size name="base_radius" unit="m" />
      {follower === "roller" ? <Size name="roller_radius" unit="m" /> : null}
      {swings ? (
        <>
          <Size name="arm" unit="m" />
          <Size name="x" unit="m" />
          <Size name="y" unit="m" />
          {follower === "flat" ? <Size name="face" unit="m" /> : null}
        </>
      ) : (
        <Size name="offset" unit="m" />
      )}
      <Size name="speed" unit="rad/s" />
      <Size name="mass" unit="kg" />
      {closure === "force" ? (
        <>
          <Size name="stiffness" unit={per!} />
          <Size name="force" unit={torque!} />
        </>
      ) : null}
    </Section>
  );
}

/** A number in the unit of the display, and this unit. */
function told(value: number | null, of: string, digits?: number): string {
  if (value === null) return camTexts.infinite;
  const { factor, unit } = displayed(of, units.value);
  return besideUnit(minus(significant(value * factor, digits)), unit);
}

function Result() {
  const words = camTexts;
  const of = found.value!;
  const { largest, at, recommended } = of.pressure_angle;
  const { least, at: where } = of.radius_of_curvature;
  const steep = largest > recommended && of.least_base !== null;
  const rows: [string, string][] = [
    [words.pressure, words.where(told(largest, "rad"), told(at, "rad"))],
    [words.radius, words.where(told(least, "m"), told(where, "rad"))],
    [words.liftOff, of.lift_off_speed === null ? words.never : told(of.lift_off_speed, "rad/s")],
  ];
  const cut = of.undercut.length > 0;
  return (
    <Section title={words.result}>
      <Facts rows={rows} />
      {cut ? (
        <p class="doc wrong" role="status" id="undercut">
          {words.undercut(of.undercut.map(([a, b]) => `${told(a, "rad")} – ${told(b, "rad")}`).join(", "))}
        </p>
      ) : null}
      {steep ? (
        <p class="doc wrong" id="steep">
          {words.steep(told(recommended, "rad"))}
        </p>
      ) : null}
      <Remedies steep={steep} />
      {of.remarks.map((remark) => (
        <p class="doc wrong" key={remark}>
          {remark.replaceAll("_", " ")}
        </p>
      ))}
      {cut || steep || of.remarks.length ? null : <p class="doc">{words.sound}</p>}
      <div class="buttons">
        <Button
          label={words.use}
          hint={words.useHint}
          onClick={() => void use()}
          kind="main"
          disabled={cut}
          id="cam-use"
        />
        <Button
          label={words.save}
          hint={words.saveHint}
          onClick={() => void saveDrawing()}
          disabled={cut}
          id="cam-dxf"
        />
        {isUsed.value ? <Button label={texts.design.run} onClick={() => enter("read")} id="run-cam" /> : null}
      </div>
      {isUsed.value ? <p class="doc">{words.used}</p> : null}
    </Section>
  );
}

/** Changes that remove an undercut or a steep pressure angle. */
function Remedies({ steep }: { steep: boolean }) {
  const words = camTexts;
  const { remedies, least_base: base, undercut } = found.value!;
  if (!remedies && !steep) return null;
  return (
    <div class="remedies">
      {remedies?.base ? (
        <Button
          label={words.larger(told(remedies.base, "m", 4))}
          onClick={() => setSizes({ base_radius: remedies.base! })}
          id="larger-base"
        />
      ) : null}
      {remedies?.roller ? (
        <Button
          label={words.smaller(told(remedies.roller[0], "m", 4))}
          hint={words.smallerHint}
          onClick={() => setSizes({ roller_radius: remedies.roller![0], base_radius: remedies.roller![1] })}
          id="smaller-roller"
        />
      ) : null}
      {steep && !undercut.length && base !== null ? (
        <Button
          label={words.larger(told(up(base), "m", 4))}
          onClick={() => setSizes({ base_radius: up(base) })}
          id="gentler"
        />
      ) : null}
    </div>
  );
}

/** With four digits, rounded up. */
function up(x: number): number {
  const unit = 10 ** (Math.floor(Math.log10(x)) - 3);
  return exact(Math.ceil(x / unit) * unit);
}
