// The slider of time below the drawing.
import { TIME } from "../modes/over";
import { course, playing, rate, show, span, time, toggle, variable } from "../modes/read";
import { clock } from "../modes/shown";
import { mode } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

const SPEEDS = [0.01, 0.1, 0.2, 0.5, 1, 2, 5];

export function Playback() {
  if (mode.value !== "read" || !course.value) return null;
  const [begin, end] = span.value;
  const words = texts.playback;
  const { name, unit } = variable.value;
  const label = variable.value === TIME ? words.time : name;
  return (
    <div class="panel playback" role="group" aria-label={label}>
      <Button
        label={playing.value ? words.pause : words.play}
        icon={playing.value ? "pause" : "play"}
        kind="main"
        id="play"
        onClick={toggle}
      />
      <input
        type="range"
        id="scrub"
        aria-label={label}
        min={begin}
        max={end}
        step="any"
        value={time.value}
        onInput={(event) => show(Number(event.currentTarget.value))}
      />
      <output class="clock">
        {variable.value === TIME ? null : <bdi class="word">{`${name} `}</bdi>}
        {clock(time.value, unit)}
      </output>
      <label class="choice">
        <span class="word">{words.speed}</span>
        {/* On a phone the word is not shown. */}
        <select
          aria-label={words.speed}
          value={String(rate.value)}
          onChange={(event) => (rate.value = Number(event.currentTarget.value))}
        >
          {SPEEDS.map((one) => (
            <option key={one} value={String(one)}>{`${one}×`}</option>
          ))}
        </select>
      </label>
    </div>
  );
}
