// Runs the four-bar linkage in the WebAssembly module and compares it with the reference solution.
//
//     node tools/wasm_four_bar.mjs MODULE.wasm
//
// Exit code: 0 if all angles agree to 1e-8 rad, 1 otherwise.

import { readFileSync } from "node:fs";

const TOLERANCE = 1e-8; // rad
const root = new URL("../", import.meta.url);
const example = readFileSync(new URL("examples/four_bar.toml", root), "utf8");
const reference = JSON.parse(readFileSync(new URL("tests/reference/four_bar.json", root), "utf8"));

const bytes = readFileSync(process.argv[2]);
const { instance } = await WebAssembly.instantiate(bytes, {});
const core = instance.exports;

/** Sends a request, see bindings/web/README.md. Memory may move when it grows, so views are made anew. */
function reply(request) {
  const encoded = new TextEncoder().encode(JSON.stringify(request));
  const address = core.request(encoded.length);
  new Uint8Array(core.memory.buffer, address, encoded.length).set(encoded);
  core.call();
  const text = new Uint8Array(core.memory.buffer, core.reply(), core.reply_length());
  return JSON.parse(new TextDecoder().decode(text));
}

function ask(request) {
  const { ok, error } = reply(request);
  if (error) throw new Error(error.message);
  return ok;
}

// A faulty case must be explained, not trap.
const faulty = ask({ do: "load", text: "kempe = 1\n[bodies.crank]\nmass = -1\n" });
if (faulty.mechanism || !faulty.problems.length) throw new Error("a faulty case was accepted");

ask({ do: "load", text: example.replace("rtol = 1e-6, atol = 1e-9", "rtol = 1e-9, atol = 1e-12") });
const begun = performance.now();
const { count, error } = ask({ do: "run", analysis: "release" });
const seconds = (performance.now() - begun) / 1e3;
if (error) throw new Error(error.message);

ask({ do: "frames" });
const frames = new Float64Array(core.memory.buffer, core.numbers(), core.numbers_length()).slice();
const bodies = ["crank", "coupler", "rocker"];
const width = 1 + 3 * bodies.length;
const column = (k) => Array.from({ length: count }, (_, row) => frames[width * row + k]);
const times = column(0);
const at = (t) => {
  const k = times.findIndex((time) => Math.abs(time - t) < 1e-12);
  if (k < 0) throw new Error(`no state is reported at t = ${t} s`);
  return k;
};
const found = Object.fromEntries(bodies.map((body, k) => [body, column(3 * k + 3)]));

let compared = 0;
let worst = 0;
const compare = (angle, truth) => {
  const error = Math.abs(angle - truth);
  worst = error <= worst ? worst : error; // NaN counts as worst
  compared += 1;
};
for (const { t, q } of [reference.start, ...reference.states]) {
  bodies.forEach((body, k) => compare(found[body][at(t)], q[3 * k + 2]));
}
const { t: grid, rocker_angle: rocker } = reference.first_second;
grid.forEach((t, k) => compare(found.rocker[at(t)], rocker[k]));

const size = `${Math.round(bytes.length / 1e3)} kB`;
const summary = `${compared} angles, largest error ${worst.toExponential(1)} rad`;
console.log(`four-bar in WebAssembly: ${summary}; ${seconds.toFixed(3)} s; module ${size}`);
process.exitCode = compared > 100 && worst <= TOLERANCE ? 0 : 1;
