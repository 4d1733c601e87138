import { expect, test } from "vitest";
import { type NumbersOf, npz, readNpz } from "../src/give/npz";
import { onAxis, storedRun } from "../src/give/stored";

const TIME = { name: "t", unit: "s" };
const CRANK = { name: "crank.angle", unit: "rad" };
const LIFT = { name: "slider.x", unit: "m" };
const FORCE = { name: "C.force", unit: "N" };

/** A stored run of this page over a variable. */
function run(variable: { name: string; unit: string }, t: number[], rows: Record<string, number[]>) {
  const n = t.length;
  const arrays = Object.entries({ t, [variable.name]: t, ...rows }).map(([name, values]) => {
    return [name, { shape: [n], values: Float64Array.from(values) }] as [string, NumbersOf];
  });
  const bytes = npz(Object.fromEntries(arrays), { variable: [variable.name, variable.unit] });
  return storedRun("run.npz", readNpz(bytes), [])!;
}

test("texts in an archive are read as they were written", () => {
  const texts = { variable: ["crank.angle", "rad"], ü: ["𝛟", ""] };
  const read = readNpz(npz({ t: { shape: [1], values: new Float64Array([1]) } }, texts));
  expect(read.texts).toEqual(texts);
  expect([...read.arrays.t!.values]).toEqual([1]);
});

test("a run over the variable of the axis has all its curves there", () => {
  for (const variable of [TIME, CRANK]) {
    const stored = run(variable, [0, 1, 2], { "slider.x": [3, 4, 5], "C.force": [6, 7, 8] });
    expect(stored.variable).toEqual(variable);
    for (const of of [LIFT, FORCE]) expect([...onAxis(stored, variable, of)!.t]).toEqual([0, 1, 2]);
  }
});

test("an angle is not drawn as the time", () => {
  const stored = run(CRANK, [0, 1, 2], { "slider.x": [3, 4, 5] });
  expect(onAxis(stored, TIME, LIFT)).toBeNull();
});

test("of a run over the time that contains the angle, only positions have a place over the angle", () => {
  const stored = run(TIME, [0, 1, 2], { "crank.angle": [0, 2, 6], "slider.x": [3, 4, 5], "C.force": [6, 7, 8] });
  const found = onAxis(stored, CRANK, LIFT)!;
  expect([[...found.t], [...found.row]]).toEqual([
    [0, 2, 6],
    [3, 4, 5],
  ]);
  expect(onAxis(stored, CRANK, FORCE)).toBeNull();
  const swings = run(TIME, [0, 1, 2], { "crank.angle": [0, 2, 1], "slider.x": [3, 4, 5] });
  expect(onAxis(swings, CRANK, LIFT)).toBeNull();
});

test("a run to lower values is read backwards", () => {
  const stored = run(CRANK, [2, 1, 0], { "slider.x": [3, 4, 5] });
  const found = onAxis(stored, CRANK, LIFT)!;
  expect([[...found.t], [...found.row]]).toEqual([
    [0, 1, 2],
    [5, 4, 3],
  ]);
});
