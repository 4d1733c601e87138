import { expect, test } from "vitest";
import type { Body } from "../src/core/protocol";
import { heldShift, ofAngle, ofLengths, ofPoint } from "../src/edit/holding";
import { lengthened } from "../src/edit/length";
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

test("a held point, or two limits without another solution nearby, let nothing move", () => {
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

test("two held lengths let a pin go to its mirror image at the line of the other ends", () => {
  const [x, y] = heldShift([2, -4.4], pin, all, new Set([ofLengths("crank"), ofLengths("coupler")]));
  expect(Math.hypot(3 + x, 4 + y)).toBeCloseTo(5, 12);
  expect(Math.hypot(3 + x - 9, y)).toBeCloseTo(6, 12);
  expect(y).toBeLessThan(-4);
});

test("two equal limits are one: a coupler between parallel cranks moves as a whole", () => {
  const d = hit("rocker", "D", [6, 0]);
  const c2 = hit("rocker", "C", [9, 4]);
  const places = [...pin, { at: [9, 4] as Point, hits: [c, c2] }];
  const held = new Set([ofLengths("crank"), ofLengths("rocker"), ofLengths("coupler"), ofAngle("coupler")]);
  const [x, y] = heldShift([2, -1], places, [...all, c2, d], held);
  expect(Math.hypot(3 + x, 4 + y)).toBeCloseTo(5, 12);
  expect((4 + y) / (3 + x)).toBeCloseTo(3 / 5, 12); // towards the wanted place
});

test("a held length and a held direction of another body meet at one place", () => {
  const held = new Set([ofLengths("crank"), ofAngle("coupler")]);
  const [x, y] = heldShift([-5.5, 1], pin, all, held);
  expect(x).toBeCloseTo(-6, 12);
  expect(y).toBeCloseTo(0, 12);
});

test("a new length keeps those of the neighbours where the circles meet", () => {
  const found = lengthened("crank", 6, all)!;
  expect(found.kept).toBe(true);
  expect(found.hits).toEqual([b, b2]);
  expect(Math.hypot(found.to[0], found.to[1])).toBeCloseTo(6, 12);
  expect(Math.hypot(found.to[0] - 9, found.to[1] - 4)).toBeCloseTo(6, 12);
  expect(found.to[1]).toBeGreaterThan(4); // the same branch
});

test("without such a place the end goes along the body, and the neighbours change", () => {
  const { to, kept } = lengthened("crank", 20, all)!;
  expect(kept).toBe(false);
  expect(to[0]).toBeCloseTo(12, 12);
  expect(to[1]).toBeCloseTo(16, 12);
  expect(lengthened("crank", Number.NaN, all)).toBeNull();
  expect(lengthened("crank", 0, all)).toBeNull();
});
