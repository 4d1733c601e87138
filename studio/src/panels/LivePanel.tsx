// The panel of live mode: play, speed, energy, parameters.
import { significant } from "../draw/numbers";
import { speedsOf } from "../edit/driving";
import * as living from "../modes/live";
import { goHome } from "../store/session";
import { mechanism, live as state, tree } from "../store/state";
import { texts } from "../texts";
import { Button, Facts, Section } from "./parts";
import { shown } from "./Readings";

const SPEEDS = [0.01, 0.05, 0.1, 0.25, 0.5, 1, 2];

export function LivePanel() {
  const words = texts.live;
  const playing = living.playing.value;
  const reset = () => {
    living.stop();
    void goHome();
  };
  return (
    <div class="properties">
      <div class="buttons">
        <Button
          label={playing ? texts.playback.pause : texts.playback.play}
          icon={playing ? "pause" : "play"}
          kind="main"
          onClick={living.toggle}
          id="live-play"
        />
        <Button label={words.step} icon="step" onClick={() => void living.step()} id="live-step" />
        <Button label={words.restart} icon="first" onClick={reset} />
        <label class="choice">
          <span>{texts.playback.speed}</span>
          <select
            value={String(living.speed.value)}
            onChange={(event) => (living.speed.value = Number(event.currentTarget.value))}
          >
            {SPEEDS.map((one) => (
              <option key={one} value={String(one)}>{`${one}×`}</option>
            ))}
          </select>
        </label>
      </div>
      <p class="doc">{words.hint}</p>
      <State />
      <Parameters />
    </div>
  );
}

function State() {
  const words = texts.live;
  const now = state.value;
  if (!now) return null;
  const { energy } = now;
  return (
    <>
      <Facts
        rows={[
          [texts.playback.time, `${now.t.toFixed(3)} s`],
          [words.residual, `${significant(now.residual, 2)}`],
        ]}
      />
      <Section title={words.energy}>
        <Facts
          rows={[
            [words.energies.kinetic, shown(energy.kinetic, "J")],
            [words.energies.potential, shown(energy.potential, "J")],
            [words.energies.dissipated, shown(energy.dissipated, "J")],
            [words.energies.work, shown(energy.work, "J")],
            [words.balance, significant(energy.balance, 2)],
          ]}
        />
      </Section>
    </>
  );
}

/** Speeds of drivers come first, in the unit of the display. */
function Parameters() {
  const all = mechanism.value?.parameters ?? [];
  if (!all.length) return null;
  const speeds = new Map(speedsOf(tree.value, all).map(({ parameter, unit }) => [parameter, unit]));
  const sorted = [...all.filter(({ name }) => speeds.has(name)), ...all.filter(({ name }) => !speeds.has(name))];
  return (
    <Section title={texts.live.parameters}>
      {sorted.map(({ name, value, unit }) => (
        <Slider key={name} name={name} value={value} unit={speeds.get(name) ?? unit ?? ""} />
      ))}
    </Section>
  );
}

/** A slider from a fifth to twice the value in the text; for zero, a range around it. */
function Slider({ name, value, unit }: { name: string; value: number; unit: string }) {
  const now = living.changed.value[name] ?? value;
  const [low, high] = value === 0 ? [-1, 1] : [Math.min(0.2 * value, 2 * value), Math.max(0.2 * value, 2 * value)];
  return (
    <label class="slider">
      <span>
        <bdi>{name}</bdi>
        <output>{shown(now, unit)}</output>
      </span>
      <input
        type="range"
        min={low}
        max={high}
        step="any"
        value={now}
        onInput={(event) => void living.setParameters({ [name]: Number(event.currentTarget.value) })}
      />
    </label>
  );
}
