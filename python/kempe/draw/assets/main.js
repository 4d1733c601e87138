// Puts the page together.
import { choices, fill, Legend } from "./channels.js";
import { Clock } from "./clock.js";
import { Drawing } from "./drawing.js";
import { movable, seekable } from "./gestures.js";
import { listen } from "./keyboard.js";
import { Motion } from "./motion.js";
import { timeDecimals } from "./numbers.js";
import { Plot } from "./plot.js";
import { palette } from "./surface.js";

const SPEEDS = [0.1, 0.2, 0.5, 1, 2, 5, 10];

const byId = (id) => document.getElementById(id);
const scene = JSON.parse(byId("scene").textContent);
const motion = new Motion(scene);
const clock = new Clock(motion, scene.playback.rate, repaint);
const drawing = new Drawing(byId("drawing"), scene, motion);
const plot = new Plot(byId("plot"), motion);
const legend = new Legend(byId("legend"), motion);
const plots = choices(scene);
const decimals = timeDecimals(motion.t);
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
  plot.paint(clock.t, colours);
  legend.paint(clock.t, colours);
  const told = clock.t.toFixed(decimals);
  byId("now").textContent = `${told} s`;
  const scrub = byId("scrub");
  scrub.value = String(clock.t);
  scrub.setAttribute("aria-valuetext", `${told} s`);
  const play = byId("play");
  play.classList.toggle("playing", clock.playing);
  play.setAttribute("aria-label", clock.playing ? "Pause" : "Play");
}

function resize() {
  drawing.resize();
  plot.resize();
  paint();
}

function showTitle() {
  byId("title").textContent = scene.title || "Linkage";
  byId("title").title = scene.title;
  byId("end").textContent = `of ${Number(motion.end.toFixed(decimals))} s`;
  byId("drawing").setAttribute("aria-label", `Drawing of ${scene.title || "the linkage"}`);
}

function choosePlot() {
  const chosen = plots[Number(byId("channel").value)] ?? { name: "nothing", curves: [] };
  plot.show(chosen.curves);
  legend.show(chosen.curves);
  byId("plot").setAttribute("aria-label", `Plot of ${chosen.name} over time`);
  byId("channel").title = chosen.name;
  repaint();
}

function connectPlot() {
  fill(byId("channel"), plots);
  byId("channel").addEventListener("change", choosePlot);
  byId("plot-panel").hidden = !plots.length || motion.t.length < 2;
  document.querySelector("main").classList.toggle("alone", byId("plot-panel").hidden);
  choosePlot();
  seekable(byId("plot"), plot, (t) => clock.seek(t), repaint);
}

function connectSpeed() {
  const select = byId("speed");
  for (const speed of SPEEDS) {
    const option = document.createElement("option");
    option.value = String(speed);
    option.textContent = `${Number((speed * scene.playback.rate).toPrecision(3))}×`;
    select.append(option);
  }
  select.value = "1";
  select.addEventListener("change", () => {
    clock.speed = Number(select.value);
  });
}

function changeSpeed(places) {
  const place = SPEEDS.indexOf(clock.speed) + places;
  clock.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, place))];
  byId("speed").value = String(clock.speed);
}

function toggle() {
  if (clock.playing) clock.pause();
  else clock.play();
}

function repeat() {
  clock.loop = !clock.loop;
  byId("loop").setAttribute("aria-pressed", String(clock.loop));
}

function zoom(factor) {
  drawing.view.zoom(factor);
  repaint();
}

function fit() {
  drawing.view.fit();
  repaint();
}

function showKeys(shown = byId("keys").hidden) {
  byId("keys").hidden = !shown;
  byId("help").setAttribute("aria-expanded", String(shown));
}

function connectPlayback() {
  const scrub = byId("scrub");
  scrub.min = String(motion.begin);
  scrub.max = String(motion.end);
  scrub.addEventListener("input", () => clock.seek(Number(scrub.value)));
  const presses = {
    play: toggle,
    first: () => clock.seek(motion.begin),
    last: () => clock.seek(motion.end),
    back: () => clock.step(-1),
    forward: () => clock.step(1),
    loop: repeat,
    "zoom-in": () => zoom(1.25),
    "zoom-out": () => zoom(0.8),
    fit,
    help: () => showKeys(),
  };
  for (const [id, press] of Object.entries(presses)) byId(id).addEventListener("click", () => press());
  if (motion.t.length > 1) return;
  for (const id of ["play", "first", "last", "back", "forward", "loop", "scrub", "speed"]) byId(id).disabled = true;
}

function connectToggles() {
  for (const what of Object.keys(drawing.shown)) {
    const box = byId(`show-${what}`);
    const follow = () => {
      drawing.shown[what] = box.checked;
      byId("arrow-size").hidden = !drawing.shown.reactions;
      repaint();
    };
    box.addEventListener("change", follow);
    follow(); // a browser may restore the boxes of an earlier visit
  }
  byId("magnify").addEventListener("input", (event) => {
    drawing.magnification = 10 ** Number(event.target.value);
    repaint();
  });
}

function connectKeys() {
  listen({
    " ": toggle,
    ArrowLeft: (count) => clock.step(-count),
    ArrowRight: (count) => clock.step(count),
    ArrowUp: () => changeSpeed(1),
    ArrowDown: () => changeSpeed(-1),
    Home: () => clock.seek(motion.begin),
    End: () => clock.seek(motion.end),
    "+": () => zoom(1.25),
    "=": () => zoom(1.25),
    "-": () => zoom(0.8),
    0: fit,
    l: repeat,
    "?": () => showKeys(),
    Escape: () => showKeys(false),
  });
}

/** What the page shows now, for programs: pins are where joints are drawn, px from the window's corner. */
function state() {
  const { left, top } = byId("drawing").getBoundingClientRect();
  const pins = drawing.pins(motion.at(clock.t)).map(({ name, at: [x, y] }) => ({ name, x: left + x, y: top + y }));
  const { t, playing, speed, loop } = clock;
  return { t, begin: motion.begin, end: motion.end, playing, speed, loop, frame: motion.nearest(t), pins };
}

showTitle();
connectPlot();
connectSpeed();
connectPlayback();
connectToggles();
connectKeys();
movable(byId("drawing"), drawing.view, repaint);
const watch = new ResizeObserver(resize);
for (const id of ["drawing", "plot"]) watch.observe(byId(id));
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  colours = palette();
  repaint();
});
resize();

window.kempe = Object.freeze({
  seek: (t) => clock.seek(t),
  play: () => clock.play(),
  pause: () => clock.pause(),
  state,
});
