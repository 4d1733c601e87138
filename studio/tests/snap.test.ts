import { expect, test } from "vitest";
import { snapped } from "../src/plane/snap";

const sheet = { points: [[1.02, 2.01]] as [number, number][], step: 0.1, scale: 100 };

test("an existing point attracts within 12 px", () => {
  expect(snapped([1.12, 2.01], sheet)).toEqual({ at: [1.02, 2.01], kind: "point" });
  expect(snapped([1.15, 2.01], sheet).kind).toBe("grid");
});

test("places on the grid have no noise of rounding", () => {
  expect(snapped([0.298, 0.71], { ...sheet, points: [] })).toEqual({ at: [0.3, 0.7], kind: "grid" });
});

test("a line near a multiple of 15 degrees gets that angle and a round length", () => {
  const angle = (30 * Math.PI) / 180;
  const { at, kind } = snapped([2.03 * Math.cos(angle), 2.03 * Math.sin(angle)], {
    ...sheet,
    points: [],
    from: [0, 0],
  });
  expect(kind).toBe("angle");
  expect(Math.hypot(...at)).toBeCloseTo(2, 6);
  expect(Math.atan2(at[1], at[0])).toBeCloseTo(angle, 6);
});

test("a typed length is kept, in the direction of the pointer", () => {
  const { at, kind } = snapped([3, 4], { ...sheet, from: [0, 0], length: 2.5 });
  expect(kind).toBe("length");
  expect(at[0]).toBeCloseTo(1.5, 5);
  expect(at[1]).toBeCloseTo(2, 5);
});
