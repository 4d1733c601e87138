// The picture behind the drawing: opening, opacity, scale.
import { useEffect, useRef, useState } from "preact/hooks";
import { lengthMeant, meantValue } from "../edit/meaning";
import { openBackdrop } from "../give/backdrop";
import { beginScaling, endScaling, removeBackdrop } from "../modes/scaling";
import { backdrop, scaleTo, scaling } from "../store/backdrop";
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
            <Button label={words.remove} icon="close" onClick={removeBackdrop} />
          </>
        ) : null}
      </div>
      {found ? (
        <label class="slider">
          <span>{words.opacity}</span>
          <input
            type="range"
            min={0}
            max={1}
            step="any"
            value={found.opacity}
            onInput={(event) => (backdrop.value = { ...found, opacity: Number(event.currentTarget.value) })}
          />
        </label>
      ) : null}
      {scaling.value?.length === 2 ? <Distance /> : null}
    </Section>
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
