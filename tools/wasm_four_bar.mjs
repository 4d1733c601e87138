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
const kempe = instance.exports;

// Memory may move when it grows, so views are made anew for each access.
const give = (text) => {
  const encoded = new TextEncoder().encode(text);
  const address = kempe.text(encoded.length);
  new Uint8Array(kempe.memory.buffer, address, encoded.length).set(encoded);
};
const numbers = (address, count) =>
  new Float64Array(kempe.memory.buffer, address, count).slice();
const check = (failed) => {
  if (failed) {
    const message = new Uint8Array(kempe.memory.buffer, kempe.message(), kempe.message_length());
    throw new Error(new TextDecoder().decode(message));
  }
};
const coordinate = (name) => {
  give(name);
  check(kempe.select());
  return numbers(kempe.coordinate(), kempe.states());
};

// A faulty case must be explained, not trap.
give("kempe = 1\n[bodies.crank]\nmass = -1\n");
if (kempe.run() !== 1 || kempe.message_length() === 0) throw new Error("a faulty case was accepted");

give(example.replace("rtol = 1e-6, atol = 1e-9", "rtol = 1e-9, atol = 1e-12"));
const begun = performance.now();
check(kempe.run());
const seconds = (performance.now() - begun) / 1e3;

const times = numbers(kempe.times(), kempe.states());
const at = (t) => {
  const k = times.findIndex((time) => Math.abs(time - t) < 1e-12);
  if (k < 0) throw new Error(`no state is reported at t = ${t} s`);
  return k;
};
const bodies = ["crank", "coupler", "rocker"];
const found = Object.fromEntries(bodies.map((body) => [body, coordinate(`${body}.angle`)]));

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
