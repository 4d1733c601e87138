// The quantities of the first plot are those that change visibly.
import { describe, expect, test } from "vitest";
import { moving } from "../src/plot/moving";

const COUNT = 50;
/** Rows of frames in which the columns x, y and angle of each body are functions of the time. */
function rowsOf(...columns: ((t: number) => number)[]): [Float64Array, number] {
  const rows = Array.from({ length: COUNT }, (_, n) => [n / COUNT, ...columns.map((of) => of(n / COUNT))]);
  return [Float64Array.from(rows.flat()), columns.length + 1];
}
const still = (at: number) => () => at;

describe.each([1e-3, 1, 1e3])("in a mechanism of size %s", (size) => {
  test("angles that change come before constant ones and positions", () => {
    const [rows, width] = rowsOf(
      ...[still(0), still(0), (t: number) => 6 * t], // a crank
      ...[(t: number) => size * Math.sin(6 * t), still(0), still(0)], // a slider
      ...[still(0), still(0), (t: number) => 0.4 * Math.sin(6 * t)], // a rocker
    );
    expect(moving(rows, width, size)).toEqual([2, 8]);
  });

  test("of equal angles, one is taken, and three at most", () => {
    const turn = (rate: number) => [still(0), still(0), (t: number) => rate * t];
    const [rows, width] = rowsOf(...[1, 1, 2, 3, 4].flatMap(turn));
    expect(moving(rows, width, size)).toEqual([2, 8, 11]);
  });

  test("where only rounding errors turn, the largest shift is taken", () => {
    const noise = (t: number) => 1.57 + 1e-8 * Math.sin(40 * t);
    const [rows, width] = rowsOf(
      ...[(t: number) => 0.1 * size * t, still(0), noise],
      ...[still(0), (t: number) => 0.2 * size * t, noise],
    );
    expect(moving(rows, width, size)).toEqual([4]);
  });

  test("where angles far from each other hardly change, the largest shift is taken", () => {
    const [rows, width] = rowsOf(
      ...[(t: number) => 0.002 * size * t, still(0), (t: number) => 0.002 * t],
      ...[still(0), still(0), (t: number) => 1.57 + 0.003 * t],
    );
    expect(moving(rows, width, size)).toEqual([0]);
  });

  test("columns that are not offered are left out", () => {
    const [rows, width] = rowsOf(
      still(0),
      (t) => size * t,
      (t) => t,
    );
    expect(moving(rows, width, size, (k) => k !== 2)).toEqual([1]);
  });
});

test("nothing is taken where nothing moves", () => {
  expect(moving(...rowsOf(still(0), still(1), still(2)), 1)).toEqual([]);
});
