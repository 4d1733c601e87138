// Puts the page together.
import { Clock } from "./clock.js";
import { Controls } from "./controls.js";
import { Drawing } from "./drawing.js";
import { csv, download, drawingPicture, fileName, plotsPicture } from "./export.js";
import { movable } from "./gestures.js";
import { listen } from "./keyboard.js";
import { Motion } from "./motion.js";
import { timeDecimals } from "./numbers.js";
import { Plots } from "./plots.js";
import { palette, paperPalette } from "./surface.js";

const ARROW_KINDS = ["reactions", "velocities", "accelerations"];

const byId = (id) => document.getElementById(id);
const scene = JSON.parse(byId("scene").textContent);
const title = scene.title || "Linkage";
const motion = new Motion(scene);
const decimals = timeDecimals(motion.t.map((t) => t / motion.variable.divisor));
const clock = new Clock(motion, scene.playback.rate, repaint);
const drawing = new Drawing(byId("drawing"), scene, motion);
const templates = { card: byId("plot-card"), entry: byId("legend-entry") };
const plots = new Plots(byId("plots"), templates, scene, motion, {
  seek: (t) => clock.seek(t),
  changed: repaint,
  counted: (more) => {
    byId("add-plot").disabled = !more;
  },
});
const controls = new Controls(byId, clock, motion, decimals, scene.events);
let colours = palette();
let waiting = false;

/** Paint before the screen is next drawn, once, however many things changed. */
function repaint() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(paint);
}

function paint() {
  waiting = false;
  drawing.paint(clock.t, colours);
  plots.paint(clock.t, colours);
  controls.paint();
}

function showTitle() {
  byId("title").textContent = title;
  byId("title").title = scene.title;
  byId("variable").textContent = `${motion.variable.name} =`;
  if (motion.variable.unit !== "s") byId("now").setAttribute("aria-label", motion.variable.name);
  byId("end").textContent = `of ${motion.withUnit(Number((motion.end / motion.variable.divisor).toFixed(decimals)))}`;
  byId("drawing").setAttribute("aria-label", `Drawing of ${scene.title || "the linkage"}`);
}

/** How many instants there are, and the error between them. */
function showSampling() {
  const percent = Number((100 * (scene.accuracy ?? 0)).toPrecision(2));
  const between = scene.accuracy === null ? "" : `; between them, forces and accelerations are within ${percent} %`;
  const count = `${motion.t.length} instants of the solution`;
  byId("sampling").textContent = motion.smooth ? count + between : `${count}, not interpolated`;
}

function connectPlots() {
  byId("plot-panel").hidden = !plots.all.length || motion.t.length < 2;
  document.querySelector("main").classList.toggle("alone", byId("plot-panel").hidden);
  if (byId("plot-panel").hidden) return;
  plots.add();
  showSampling();
  byId("degrees").addEventListener("change", (event) => plots.setDegrees(event.target.checked));
}

function addPlot() {
  plots.add();
  plots.cards[plots.cards.length - 1].element.scrollIntoView({ block: "nearest" });
}

/** The present instant as a number and as text. */
function instant() {
  return [clock.t, motion.named(clock.t, decimals)];
}

function saveDrawing() {
  download(fileName(title, "drawing.png"), drawingPicture(drawing, ...instant(), title, paperPalette()));
}

function savePlots() {
  download(fileName(title, "plots.png"), plotsPicture(plots.cards, ...instant(), title, paperPalette()));
}

function saveValues() {
  download(fileName(title, "values.csv"), csv(motion, plots.cards.flatMap(({ plot }) => plot.curves)));
}

function zoom(factor) {
  drawing.view.zoom(factor);
  repaint();
}

function fit() {
  drawing.view.fit();
  repaint();
}

function magnifyArrows(factor) {
  drawing.magnification = Math.min(1e4, Math.max(1e-2, drawing.magnification * factor));
  repaint();
}

function showKeys(shown = byId("keys").hidden) {
  byId("keys").hidden = !shown;
  byId("help").setAttribute("aria-expanded", String(shown));
}

function connectButtons() {
  const presses = {
    play: () => controls.toggle(),
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
    help: () => showKeys(),
    "add-plot": addPlot,
    "save-drawing": saveDrawing,
    "save-plots": savePlots,
    "save-values": saveValues,
  };
  for (const [id, press] of Object.entries(presses)) byId(id).addEventListener("click", () => press());
}

function connectToggles() {
  for (const what of Object.keys(drawing.shown)) {
    const box = byId(`show-${what}`);
    const follow = () => {
      drawing.shown[what] = box.checked;
      for (const id of ["longer", "shorter"]) byId(id).hidden = !ARROW_KINDS.some((kind) => drawing.shown[kind]);
      repaint();
    };
    box.addEventListener("change", follow);
    follow(); // a browser may restore the boxes of an earlier visit
  }
}

function connectKeys() {
  listen({
    " ": () => controls.toggle(),
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
    "?": () => showKeys(),
    Escape: () => showKeys(false),
  });
}

/** What the page shows now, for programs: pins are where joints are drawn, px from the window's corner. */
function state() {
  const { left, top } = byId("drawing").getBoundingClientRect();
  const pins = drawing.pins(motion.at(clock.t)).map(({ name, at: [x, y] }) => ({ name, x: left + x, y: top + y }));
  const { t, playing, speed, loop } = clock;
  const shown = plots.cards.map(({ name, plot, entries }) => {
    const values = entries.map(({ curve, value }) => ({ name: curve.name, text: value.textContent }));
    return { name, label: plot.label, reading: plot.reading, range: plot.range, values };
  });
  const arrows = drawing.arrows.map(({ kind, element, from, to, whole, text, box }) => ({ kind, element, from, to, whole, text, box }));
  return { t, begin: motion.begin, end: motion.end, playing, speed, loop, frame: motion.nearest(t), pins, plots: shown, arrows };
}

showTitle();
connectPlots();
connectButtons();
connectToggles();
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

window.kempe = Object.freeze({
  seek: (t) => clock.seek(t),
  play: () => clock.play(),
  pause: () => clock.pause(),
  state,
});
