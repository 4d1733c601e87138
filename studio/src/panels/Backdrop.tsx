// The picture behind the drawing: opening, opacity, scale.
import { useEffect, useRef, useState } from "preact/hooks";
import { lengthMeant, meantValue } from "../edit/meaning";
import { openBackdrop } from "../give/backdrop";
import { beginScaling, endScaling, removeBackdrop } from "../modes/scaling";
import { backdrop, type Backdrop as Picture, scaleTo, scaling, shifting } from "../store/backdrop";
import { report } from "../store/session";
import { units } from "../store/state";
import { texts } from "../texts";
import { Button, Section } from "./parts";

export function Backdrop() {
  const words = texts.picture;
  const found = backdrop.value;
  return (
    <Section title={words.title}>
      <div class="buttons">
        <Button label={words.open} onClick={openBackdrop} id="picture" />
        {found ? (
          <>
            <Button label={words.scale} onClick={beginScaling} />
            <Button
              label={words.move}
              hint={words.moveHint}
              pressed={shifting.value}
              onClick={() => (shifting.value = !shifting.value)}
            />
            <Button label={words.remove} icon="close" onClick={removeBackdrop} />
          </>
        ) : null}
      </div>
      {found ? (
        <>
          <Slider label={words.opacity} most={1} of={found.opacity} keep={(opacity) => ({ ...found, opacity })} />
          <Slider
            label={words.angle}
            least={-180}
            most={180}
            of={(found.angle * 180) / Math.PI}
            keep={(degrees) => ({ ...found, angle: (degrees * Math.PI) / 180 })}
          />
        </>
      ) : null}
      {scaling.value?.length === 2 ? <Distance /> : null}
    </Section>
  );
}

interface SliderProps {
  label: string;
  least?: number;
  most: number;
  of: number;
  keep(value: number): Picture;
}

function Slider({ label, least = 0, most, of, keep }: SliderProps) {
  return (
    <label class="slider">
      <span>{label}</span>
      <input
        type="range"
        min={least}
        max={most}
        step={most / 100}
        value={of}
        onInput={(event) => (backdrop.value = keep(Number(event.currentTarget.value)))}
      />
    </label>
  );
}

/** The known distance of the two points. */
function Distance() {
  const [length, setLength] = useState("");
  const unit = units.value.length;
  const input = useRef<HTMLInputElement>(null);
  useEffect(() => input.current?.focus(), []);
  const apply = async () => {
    const metres = meantValue(await lengthMeant(length));
    if (metres === undefined) return;
    scaleTo(metres);
    endScaling();
  };
  return (
    <form
      class="adding"
      onSubmit={(event) => {
        event.preventDefault();
        void apply().catch(report);
      }}
    >
      <input
        ref={input}
        type="text"
        autocomplete="off"
        title={texts.edit.lengthHint(unit)}
        aria-label={texts.picture.distance(unit)}
        placeholder={texts.picture.distance(unit)}
        value={length}
        onInput={(event) => setLength(event.currentTarget.value)}
      />
      <Button label={texts.picture.apply} onClick={() => void apply().catch(report)} disabled={!length.trim()} />
    </form>
  );
}
