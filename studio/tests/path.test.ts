import { expect, test } from "vitest";
import { mappedPath } from "../src/edit/path";

test("absolute places are scaled, turned upside down and moved", () => {
  expect(mappedPath("M10 20L30,40H5V-6z", 0.1, [1, 2])).toBe("M 2 0 L 4 -2 H 1.5 V 2.6 z");
});

test("relative steps are not moved, but the first place is", () => {
  expect(mappedPath("m10 20 1 2l5 5h2v-3c1 2 3 4 5 6", 1, [100, 200])).toBe(
    "M 110 180 l 1 -2 l 5 -5 h 2 v 3 c 1 -2 3 -4 5 -6",
  );
});

test("arcs turn the other way", () => {
  expect(mappedPath("M0 0A5 2 30 0 1 10 10", 2, [0, 0])).toBe("M 0 0 A 10 4 -30 0 0 20 -20");
});

test("other texts give no path", () => {
  expect(mappedPath("M0", 1, [0, 0])).toBeNull();
  expect(mappedPath("", 1, [0, 0])).toBeNull();
  expect(mappedPath("M0 0 R 1 1", 1, [0, 0])).toBeNull();
});
