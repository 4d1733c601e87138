import { expect, test } from "vitest";
import { plainly } from "../src/store/blame";
import { texts } from "../src/texts";

test("a singular position is a dead point in words, with the joints that it concerns", () => {
  const message =
    "singular position at t = 0.52 s: constraint motor.angle depends on the others, so reactions and accelerations are " +
    "not unique (joints A, B, motor; at crank x = 0.02)";
  expect(plainly(message)).toBe(texts.read.singular("t = 0.52 s", "A, B, motor"));
  expect(plainly("singular position")).toBe(texts.read.undetermined);
  expect(plainly("the loop A-B cannot close")).toBe("the loop A-B cannot close");
});
