// The picture behind the drawing: opening, opacity, scale.
import { useState } from "preact/hooks";
import { LENGTHS } from "../draw/display";
import { openBackdrop } from "../give/backdrop";
import { beginScaling, endScaling, removeBackdrop } from "../modes/scaling";
import { backdrop, scaleTo, scaling } from "../store/backdrop";
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
  const apply = () => {
    scaleTo(Number(length) / LENGTHS[unit]);
    endScaling();
  };
  return (
    <form
      class="adding"
      onSubmit={(event) => {
        event.preventDefault();
        apply();
      }}
    >
      <input
        type="text"
        inputMode="decimal"
        autocomplete="off"
        aria-label={texts.picture.distance(unit)}
        placeholder={texts.picture.distance(unit)}
        value={length}
        onInput={(event) => setLength(event.currentTarget.value)}
      />
      <Button label={texts.picture.apply} onClick={apply} disabled={!(Number(length) > 0)} />
    </form>
  );
}
