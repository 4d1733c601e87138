// Which paths of points are drawn.
import { expect, test } from "vitest";
import { distinctPaths, type Path } from "../src/plane/paths";
import type { Point } from "../src/plane/points";

const TURNS = Array.from({ length: 61 }, (_, k) => (k * Math.PI) / 30);

function path(name: string, at: (angle: number) => Point): Path {
  return { name, body: 1, line: TURNS.map(at) };
}

const circle =
  (radius: number) =>
  (angle: number): Point => [radius * Math.cos(angle), radius * Math.sin(angle)];

test("points at rest, and points that go with one before them, have no path", () => {
  const all = [
    path("crank.O", () => [0, 0]),
    path("crank.A", circle(0.1)),
    path("rod.A", circle(0.1)),
    path("rod.B", (angle) => [0.3 + 0.1 * Math.cos(angle), 0]),
    path("wide", circle(0.2)),
  ];
  expect(distinctPaths(all).map(({ name }) => name)).toEqual(["crank.A", "rod.B", "wide"]);
});

test("points that meet at the ends of a run only keep their paths", () => {
  const all = [path("there", circle(1)), path("and back", (angle) => [Math.cos(angle), -Math.sin(angle)])];
  expect(distinctPaths(all)).toHaveLength(2);
});

test("a run of one state has no paths", () => {
  expect(distinctPaths([{ name: "A", body: 1, line: [[1, 2]] }])).toEqual([]);
});
