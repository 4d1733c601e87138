// The panel of move mode: assembly modes, held coordinates, playing the drivers, mobility.

import * as living from "../modes/live";
import { choose, configurations, findConfigurations, locked } from "../modes/move";
import { goHome } from "../store/session";
import { mechanism, pose } from "../store/state";
import { texts } from "../texts";
import { Mobility } from "./Mobility";
import { Button, Check, Section } from "./parts";
import { Speeds } from "./Speeds";

export function MovePanel() {
  const words = texts.move;
  const found = configurations.value;
  return (
    <div class="properties">
      <p class="doc">{words.hint}</p>
      <div class="buttons">
        <Button label={words.reset} onClick={() => void goHome()} />
        {mechanism.value?.drivers.length ? (
          <Button
            label={living.playing.value ? texts.playback.pause : words.play}
            onClick={living.toggle}
            id="play-drivers"
          />
        ) : null}
      </div>
      <Speeds />
      <Section title={words.configurations}>
        <Button label={words.find} onClick={() => void findConfigurations()} id="find-configurations" />
        {found ? (
          <>
            <div class="choices" role="group" aria-label={words.configurations}>
              {found.poses.map((one, k) => (
                <Button
                  key={k}
                  label={words.mode(k + 1)}
                  onClick={() => void choose(one)}
                  pressed={same(one.q, pose.value?.q)}
                />
              ))}
            </div>
            <p class="doc">{found.complete ? words.complete : words.partial}</p>
          </>
        ) : null}
      </Section>
      <Mobility />
      <Locks />
    </div>
  );
}

function same(a: number[], b: number[] | undefined): boolean {
  return b !== undefined && a.every((one, k) => Math.abs(one - b[k]!) < 1e-6);
}

function Locks() {
  const names = mechanism.value?.coordinates ?? [];
  if (!names.length || names.length > 60) return null;
  const hold = (name: string, held: boolean) =>
    (locked.value = held ? [...locked.value, name] : locked.value.filter((one) => one !== name));
  return (
    <Section title={texts.move.locked}>
      <div class="locks">
        {names.map((name) => (
          <Check key={name} label={name} checked={locked.value.includes(name)} onChange={(held) => hold(name, held)} />
        ))}
      </div>
    </Section>
  );
}
