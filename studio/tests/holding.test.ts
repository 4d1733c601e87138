import { expect, test } from "vitest";
import type { Body } from "../src/core/protocol";
import { heldShift, ofAngle, ofLengths, ofPoint } from "../src/edit/holding";
import type { PointHit } from "../src/plane/hits";
import type { Point } from "../src/plane/points";

const hit = (name: string, point: string, at: Point): PointHit => ({ body: { name } as Body, point, at });
const a = hit("crank", "A", [0, 0]);
const b = hit("crank", "B", [3, 4]);
const b2 = hit("coupler", "B", [3, 4]);
const c = hit("coupler", "C", [9, 4]);
const all = [a, b, b2, c];
const pin = [{ at: [3, 4] as Point, hits: [b, b2] }];

test("without anything held, the shift is the wanted one", () => {
  expect(heldShift([1, 2], pin, all, new Set())).toEqual([1, 2]);
});

test("a held length keeps the distance from the other end", () => {
  const [x, y] = heldShift([2, 1], pin, all, new Set([ofLengths("crank")]));
  expect(Math.hypot(3 + x, 4 + y)).toBeCloseTo(5, 12);
  expect(x).toBeGreaterThan(0);
});

test("a held angle keeps the direction of the body", () => {
  const [x, y] = heldShift([2, 1], pin, all, new Set([ofAngle("crank")]));
  expect(y / x).toBeCloseTo(4 / 3, 12);
});

test("a held point, or two limits, let nothing move", () => {
  expect(heldShift([2, 1], pin, all, new Set([ofPoint("coupler", "B")]))).toEqual([0, 0]);
  expect(heldShift([2, 1], pin, all, new Set([ofLengths("crank"), ofLengths("coupler")]))).toEqual([0, 0]);
  expect(heldShift([2, 1], pin, all, new Set([ofLengths("crank"), ofAngle("crank")]))).toEqual([0, 0]);
});

test("a body that moves as a whole keeps its own length, and that of its neighbour if it is held", () => {
  const places = [{ at: [0, 0] as Point, hits: [a] }, ...pin];
  expect(heldShift([2, 1], places, all, new Set([ofLengths("crank")]))).toEqual([2, 1]);
  const [x, y] = heldShift([2, 1], places, all, new Set([ofLengths("coupler")]));
  expect(Math.hypot(6 - x, y)).toBeCloseTo(6, 12);
});
