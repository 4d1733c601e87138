// The bar at the top: title, files, history, modes.

import { begin, openFile, saveFile } from "../give/files";
import { phase, step } from "../guide/guide";
import { enter } from "../modes/modes";
import { future, past, redo, undo } from "../store/document";
import { dialog, MODES, type Mode, mode, title } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

export function Toolbar() {
  const { menu, menuHints } = texts;
  return (
    <header>
      <h1 dir="auto" title={title.value}>
        {title.value || texts.untitled}
      </h1>
      <nav class="buttons" aria-label={texts.name}>
        <Button label={menu.new} onClick={() => void begin()} id="new" />
        <Button label={menu.open} hint={menuHints.open} onClick={() => void openFile()} id="open" />
        <Button label={menu.gallery} hint={menuHints.gallery} onClick={() => open("gallery")} id="gallery" />
        <Button label={menu.save} hint={menuHints.save} onClick={() => void saveFile()} id="save" />
        <Button label={menu.share} hint={menuHints.share} onClick={() => open("share")} id="share" />
        <span class="rule" />
        <Button
          label={menu.undo}
          hint={menuHints.undo}
          icon="undo"
          onClick={() => void undo()}
          disabled={!past.value.length}
          id="undo"
        />
        <Button
          label={menu.redo}
          hint={menuHints.redo}
          icon="redo"
          onClick={() => void redo()}
          disabled={!future.value.length}
          id="redo"
        />
        <Button
          label={texts.help.title}
          hint={`${texts.help.title} (?)`}
          icon="help"
          onClick={() => open("help")}
          id="help"
        />
      </nav>
      <div class="modes" role="radiogroup" aria-label={texts.modesName}>
        {MODES.map((one) => (
          <button
            key={one}
            type="button"
            role="radio"
            id={`mode-${one}`}
            class={phase.value === "mode" && step.value?.mode === one ? "next" : ""}
            aria-checked={mode.value === one}
            title={texts.modeHints[one]}
            onClick={(event) => choose(one, event)}
          >
            {texts.modes[one]}
          </button>
        ))}
      </div>
    </header>
  );
}

/** After a click with the mouse, return the keys to the drawing: space plays and pauses. */
function choose(one: Mode, { detail }: MouseEvent): void {
  enter(one);
  if (detail > 0) document.getElementById("sheet")?.focus();
}

function open(which: "gallery" | "share" | "help"): void {
  dialog.value = which;
}
