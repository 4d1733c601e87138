// Puts the page together.
import { ARROW_KINDS } from "../draw/arrows";
import { ACTING } from "../draw/ends";
import { shortened } from "../draw/numbers";
import { soon } from "../draw/soon";
import { palette } from "../draw/surface";
import { timeDecimals } from "../draw/ticks";
import { download, nameOf } from "../give/download";
import type { Head } from "../give/picture";
import { playerTexts as texts } from "../texts";
import { Clock } from "./clock";
import { Controls } from "./controls";
import { Drawing } from "./drawing";
import { byId } from "./elements";
import { saveDrawing, savePlots, table } from "./export";
import { movable } from "./gestures";
import { showSampling, showTitle } from "./heading";
import { listen } from "./keyboard";
import { Motion } from "./motion";
import { Plots } from "./plots";
import { parsed } from "./scene";
import "./player.css";

const scene = parsed(byId("scene").textContent ?? "");
const title = scene.title || texts.linkage;
const motion = new Motion(scene);
const decimals = timeDecimals(motion.t.map((t) => t / motion.variable.divisor));
const clock = new Clock(motion, scene.playback.rate, repaint);
const drawing = new Drawing(byId("drawing"), scene, motion);
const templates = { card: byId<HTMLTemplateElement>("plot-card"), entry: byId<HTMLTemplateElement>("legend-entry") };
const plots = new Plots(byId("plots"), templates, scene, motion, {
  seek: (t) => clock.seek(t),
  changed: repaint,
  counted: (more) => {
    byId<HTMLButtonElement>("add-plot").disabled = !more;
  },
});
const controls = new Controls(clock, motion, decimals, scene.events);
const painting = soon(paint);
let colours = palette();

function repaint(): void {
  painting();
}

function paint(): void {
  drawing.paint(clock.t, colours);
  plots.paint(clock.t, colours);
  controls.paint();
}

function connectPlots(): void {
  const panel = byId("plot-panel");
  panel.hidden = !plots.all.length || motion.t.length < 2;
  document.querySelector("main")!.classList.toggle("alone", panel.hidden);
  if (panel.hidden) return;
  plots.add();
  showSampling(scene, motion);
  const degrees = byId<HTMLInputElement>("degrees");
  degrees.addEventListener("change", () => plots.setDegrees(degrees.checked));
}

function addPlot(): void {
  plots.add();
  plots.cards[plots.cards.length - 1]!.element.scrollIntoView({ block: "nearest" });
}

function head(): Head {
  return { title, t: clock.t, instant: motion.named(clock.t, decimals) };
}

function saveValues(): void {
  const curves = plots.cards.flatMap(({ curves }) => curves);
  download(nameOf(title, "_values.csv"), table(motion, curves), "text/csv;charset=utf-8");
}

function zoom(factor: number): void {
  drawing.view.zoom(factor);
  repaint();
}

function fit(): void {
  drawing.view.fit();
  repaint();
}

function magnifyArrows(factor: number): void {
  drawing.magnification = Math.min(1e4, Math.max(1e-2, drawing.magnification * factor));
  repaint();
}

function showKeys(shown: boolean): void {
  byId("keys").hidden = !shown;
  byId("help").setAttribute("aria-expanded", String(shown));
}

function toggleKeys(): void {
  showKeys(Boolean(byId("keys").hidden));
}

function connectButtons(): void {
  const presses: Record<string, () => void> = {
    play: () => clock.toggle(),
    first: () => clock.seek(motion.begin),
    last: () => clock.seek(motion.end),
    back: () => clock.step(-1),
    forward: () => clock.step(1),
    loop: () => controls.repeat(),
    "zoom-in": () => zoom(1.25),
    "zoom-out": () => zoom(0.8),
    fit,
    longer: () => magnifyArrows(1.5),
    shorter: () => magnifyArrows(1 / 1.5),
    help: toggleKeys,
    "add-plot": addPlot,
    "save-drawing": () => saveDrawing(drawing, head()),
    "save-plots": () => savePlots(plots.cards, head()),
    "save-values": saveValues,
  };
  for (const [id, press] of Object.entries(presses)) byId(id).addEventListener("click", () => press());
}

function connectToggles(): void {
  for (const what of Object.keys(drawing.shown) as (keyof Drawing["shown"])[]) {
    const box = byId<HTMLInputElement>(`show-${what}`);
    const follow = () => {
      drawing.shown[what] = box.checked;
      for (const id of ["longer", "shorter"]) byId(id).hidden = !ARROW_KINDS.some((kind) => drawing.shown[kind]);
      repaint();
    };
    box.addEventListener("change", follow);
    follow(); // a browser may restore the boxes of an earlier visit
  }
}

/** Fill the choice of the body whose arrows are shown. Names are inserted as text, so that markup has no effect. */
function connectBodies(): void {
  const choice = byId<HTMLSelectElement>("on-body");
  const listed = scene.bodies.map(({ name, number }) => new Option(shortened(name, 24), String(number)));
  choice.append(...listed);
  choice.addEventListener("change", () => {
    drawing.onBody = choice.value === "" ? null : Number(choice.value);
    repaint();
  });
  const forces: readonly string[] = ACTING.force;
  byId("forces").hidden = !scene.undetermined && !scene.ends.some(({ group }) => forces.includes(group));
}

function connectKeys(): void {
  listen({
    " ": () => clock.toggle(),
    ArrowLeft: (count) => clock.step(-count),
    ArrowRight: (count) => clock.step(count),
    ArrowUp: () => controls.changeSpeed(1),
    ArrowDown: () => controls.changeSpeed(-1),
    Home: () => clock.seek(motion.begin),
    End: () => clock.seek(motion.end),
    "+": () => zoom(1.25),
    "=": () => zoom(1.25),
    "-": () => zoom(0.8),
    0: fit,
    l: () => controls.repeat(),
    "?": toggleKeys,
    Escape: () => showKeys(false),
  });
}

/** The present state of the page, for programs. Pins are the drawn joints, px from the corner of the window. */
function state() {
  const { left, top } = byId("drawing").getBoundingClientRect();
  const pins = drawing.pins(motion.at(clock.t)).map(({ name, at: [x, y] }) => ({ name, x: left + x, y: top + y }));
  const shown = plots.cards.map(({ name, plot: { label, reading, range }, entries }) => {
    const values = entries.map(({ curve, value }) => ({ name: curve.name, text: value.textContent }));
    return { name, label, reading, range, values };
  });
  const { t, playing, speed, loop } = clock;
  const { begin, end } = motion;
  return { t, begin, end, playing, speed, loop, frame: motion.nearest(t), pins, plots: shown, arrows: drawing.arrows };
}

showTitle(scene, motion, decimals);
connectPlots();
connectButtons();
connectToggles();
connectBodies();
connectKeys();
movable(byId("drawing"), drawing.view, repaint);
new ResizeObserver(() => {
  drawing.resize();
  repaint();
}).observe(byId("drawing"));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  colours = palette();
  repaint();
});
paint();

/** The page for programs: tests, and pages around it. */
Object.assign(window, {
  kempe: Object.freeze({
    seek: (t: number) => clock.seek(t),
    play: () => clock.play(),
    pause: () => clock.pause(),
    state,
  }),
});
