import { beforeAll, expect, test } from "vitest";
import { angleTicks } from "../src/draw/ticks";
import type { Point } from "../src/plane/points";
import { peakOf, straight, symbolOf } from "../src/plot/straight";
import { TimeSpan } from "../src/plot/timespan";

beforeAll(() => {
  // a path of the canvas, which a browser has
  Object.assign(globalThis, {
    Path2D: class {
      moveTo() {}
      lineTo() {}
      closePath() {}
    },
  });
});

const WIDTH = 100;

function curve(values: number[], t = values.map((_, k) => k)) {
  return straight({ name: "a.x", unit: "m", number: 0, stored: false, t, values });
}

/** The places to which a curve is drawn, with null where it begins anew. */
async function drawn(values: number[]): Promise<Point[]> {
  const { lineOf } = await import("../src/plot/line");
  const of = curve(values);
  const place = (t: number, value: number): Point | null =>
    Number.isFinite(value) ? [(t / values.length) * WIDTH, value] : null;
  const { text } = lineOf(of, [0, values.length - 1], WIDTH, place);
  return text.split(/(?=[ML])/).map((one) => one.slice(1).split(" ").map(Number) as Point);
}

test("values between outputs lie on a straight line, and none is made of a gap", () => {
  const of = curve([0, 2, Number.NaN, 4]);
  expect([of.at(0.5), of.at(1), of.at(3), of.at(9)]).toEqual([1, 2, 4, 4]);
  expect(of.at(1.5)).toBeNaN();
  expect(of.at(2.5)).toBeNaN();
  expect(peakOf(curve([1, -3, 2]))).toBe(-3);
});

test("of many outputs on a pixel, the least and the largest are drawn", async () => {
  const values = Array.from({ length: 50_000 }, (_, k) => Math.sin(k / 1000));
  values[31_234] = 7;
  values[31_235] = -8;
  const points = await drawn(values);
  expect(points.length).toBeLessThan(5 * WIDTH);
  const heights = points.map(([, y]) => y);
  expect([Math.min(...heights), Math.max(...heights)]).toEqual([-8, 7]);
  expect(points.at(-1)![1]).toBeCloseTo(values.at(-1)!, 12);
});

test("a curve without a value has a gap", async () => {
  const { lineOf } = await import("../src/plot/line");
  const place = (t: number, value: number): Point | null => (Number.isFinite(value) ? [t, value] : null);
  expect(lineOf(curve([1, 2, Number.NaN, 3, 4]), [0, 4], WIDTH, place).text).toBe("M0 1L1 2M3 3L4 4");
});

test("ticks of angles are those of a protractor", () => {
  expect(angleTicks(0, 360, 4).values).toEqual([0, 90, 180, 270, 360]);
  expect(angleTicks(-60, 60, 4).values).toEqual([-60, -30, 0, 30, 60]);
  expect(angleTicks(0, 3, 4).values.length).toBeGreaterThan(3);
});

test("an axis is named after its only curve, or what all of them are", () => {
  expect(symbolOf(["C.force"])).toBe("C.force");
  expect(symbolOf(["crank.angle", "rocker.B.angle"])).toBe("angle");
  expect(symbolOf(["crank.angle", "rocker.x"])).toBe("");
});

test("a window is stretched around a place and stays within its ends", () => {
  const span = new TimeSpan({ begin: 0, end: 10 });
  span.stretch(0.5, 4);
  expect([span.from, span.to]).toEqual([2, 7]);
  span.follow(9);
  expect(span.to - span.from).toBe(5);
  expect(span.to).toBeLessThanOrEqual(10);
  span.stretch(10, 7);
  expect([span.from, span.to]).toEqual([0, 10]);
});
