// The canvas with its tools.
import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import { soon } from "../draw/soon";
import { cleared, palette, sharpen } from "../draw/surface";
import { cancelGif, making, saveGif } from "../give/gif";
import { saveDrawing, saveDrawingSvg } from "../give/pictures";
import { readLength } from "../modes/length";
import { openMenu } from "../modes/menu";
import { handler } from "../modes/modes";
import { drawing, finish, restart } from "../modes/place";
import { listenToPointer } from "../modes/pointer";
import { course } from "../modes/read";
import { follow, paintSheet } from "../page/painting";
import { report, resized } from "../store/session";
import { fit, preview, typedLength, view, viewChanged, zoom } from "../store/sheet";
import { items, mode, shown, snapping, title, tool, units } from "../store/state";
import { texts } from "../texts";
import { Guide } from "./Guide";
import { Menu } from "./Menu";
import { Note } from "./Note";
import { Button, Check } from "./parts";

/** The mark that benchmarks/studio_page.py reads. */
const FIRST = "first picture";

export function Sheet() {
  const words = texts.sheet;
  return (
    <section class="panel sheet-panel" aria-label={words.label(title.value || texts.untitled)}>
      <div class="bar">
        <div class="chips">
          {(["names", "numbers", "grid", "traces"] as const).map((what) => (
            <Check
              key={what}
              label={words.shown[what]}
              checked={shown.value[what]}
              onChange={(value) => (shown.value = { ...shown.value, [what]: value })}
            />
          ))}
          {mode.value === "edit" || mode.value === "design" ? (
            <Check
              label={words.snap}
              hint={words.snapHint}
              checked={snapping.value}
              onChange={(value) => (snapping.value = value)}
            />
          ) : null}
        </div>
        <div class="buttons">
          <Button label={words.zoomIn} icon="plus" onClick={() => zoom(1.25)} />
          <Button label={words.zoomOut} icon="minus" onClick={() => zoom(0.8)} />
          <Button label={words.fitHint} onClick={fit}>
            {words.fit}
          </Button>
          <Button label={words.pngHint} onClick={saveDrawing}>
            {texts.files.png}
          </Button>
          <Button label={words.svgHint} onClick={saveDrawingSvg}>
            {texts.files.svg}
          </Button>
          <Gif />
        </div>
      </div>
      <div class="tool-place">
        <ToolBox />
      </div>
      <div class="space">
        <Drawing />
        <Guide />
        <Note />
        <Menu />
      </div>
    </section>
  );
}

/** The canvas. A fixed one leaves the pointer to the page around it, which may scroll. */
export function Drawing({ fixed = false }: { fixed?: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  useEffect(() => connect(canvas.current!, fixed), []);
  const label = texts.sheet.label(title.value || texts.untitled);
  return <canvas id="sheet" ref={canvas} tabIndex={fixed ? -1 : 0} role="img" aria-label={label} />;
}

/** The button that saves the motion as a GIF. While the GIF is made, it shows the progress, and a click cancels. */
function Gif() {
  if (mode.value !== "read" || !course.value) return null;
  const { gifHint, gifCancel, gifProgress } = texts.sheet;
  const share = making.value;
  return (
    <Button
      label={share === null ? gifHint : gifCancel}
      onClick={share === null ? () => void saveGif() : cancelGif}
      id="gif"
    >
      {share === null ? texts.files.gif : gifProgress(Math.round(100 * share))}
    </Button>
  );
}

/** The controls of the active tool: the typed length, and the button that ends the tool. */
function ToolBox() {
  const active = tool.value;
  preview.value;
  if (!active || mode.value !== "edit") return null;
  const words = texts.sheet;
  return (
    <div class="toolbox" role="group" aria-label={active.label}>
      <strong>{active.label}</strong>
      {active.placing === "two" || active.placing === "many" ? (
        <label>
          {words.length(units.value.length)}
          <input
            id="typed-length"
            size={9}
            autocomplete="off"
            spellcheck={false}
            title={texts.edit.lengthHint(units.value.length)}
            value={typedLength.value}
            onInput={(event) => (typedLength.value = event.currentTarget.value)}
            onChange={() => void readLength().catch(report)}
          />
        </label>
      ) : null}
      {active.placing === "many" && drawing() ? <Button label={words.finish} onClick={() => void finish()} /> : null}
      <Button label={words.stop} onClick={() => restart(null)} />
    </div>
  );
}

/** Paint after each change of the drawing, at most once for each frame of the screen. */
function connect(canvas: HTMLCanvasElement, fixed: boolean): () => void {
  let colours = palette();
  const paint = soon(() => {
    sharpen(canvas);
    paintSheet(cleared(canvas), colours);
    if (items.peek().length && !performance.getEntriesByName(FIRST).length) performance.mark(FIRST);
  });
  const stop = effect(() => {
    follow();
    paint();
  });
  if (!fixed) listenToPointer(canvas, view, handler, viewChanged, (spot) => void openMenu(spot).catch(report));
  const observer = new ResizeObserver(() => {
    const { width, height } = canvas.getBoundingClientRect();
    view.resize(width, height);
    resized(width, height);
    viewChanged();
  });
  observer.observe(canvas);
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const recolour = () => {
    colours = palette();
    viewChanged();
  };
  dark.addEventListener("change", recolour);
  return () => {
    stop();
    observer.disconnect();
    dark.removeEventListener("change", recolour);
  };
}
