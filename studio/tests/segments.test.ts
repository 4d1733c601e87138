import { expect, test } from "vitest";
import { asked, sizes } from "../src/design/cam";
import { dragged, ends, filled, levels, missing, type Segment } from "../src/design/segments";

function programme(...parts: [Segment["way"], number, number | null][]): Segment[] {
  return parts.map(([way, angle, height]) => ({ way, angle, height, law: "cycloidal" }));
}

const TURN = programme(["dwell", 60, null], ["rise", 100, 0.01], ["dwell", 40, null], ["return", 160, null]);

test("lifts and angles at the ends of segments add up", () => {
  expect(levels(TURN)).toEqual([0, 0, 0.01, 0.01, 0]);
  expect(ends(TURN)).toEqual([0, 60, 160, 200, 360]);
  expect(levels(programme(["rise", 90, 0.02], ["return", 90, 0.005], ["return", 180, null]))).toEqual([
    0, 0.02, 0.015, 0,
  ]);
});

test("what a turn lacks is a dwell, and what is too much is taken from the end", () => {
  const [short, long] = [TURN.slice(0, 3), [...TURN, ...programme(["dwell", 70, null])]];
  expect(missing(TURN)).toBe(0);
  expect(missing(short)).toBe(160);
  expect(filled(short).map(({ angle }) => angle)).toEqual([60, 100, 200]);
  expect(filled(programme(["rise", 100, 1])).at(-1)).toMatchObject({ way: "dwell", angle: 260 });
  expect(filled(long)).toEqual(TURN);
  expect(filled([...TURN, ...programme(["dwell", 70, null], ["dwell", 5, null])])).toEqual(TURN);
});

test("a knot moves the end of a segment, and the turn stays one", () => {
  const made = dragged(TURN, 0, 75, 0);
  expect(ends(made)).toEqual([0, 75, 160, 200, 360]);
  expect(ends(dragged(TURN, 0, 500, 0))).toEqual([0, 159, 160, 200, 360]);
  expect(TURN[0]!.angle).toBe(60);
});

test("a knot lifts the dwell beside it, and no segment changes its direction", () => {
  for (const k of [1, 2]) expect(levels(dragged(TURN, k, 160, 0.012))).toEqual([0, 0, 0.012, 0.012, 0]);
  // the first dwell is at no lift
  expect(levels(dragged(TURN, 0, 60, 0.003))).toEqual(levels(TURN));
  expect(levels(dragged(TURN, 1, 160, -0.01))).toEqual(levels(TURN));
  const steps = programme(["rise", 90, 0.01], ["rise", 90, 0.01], ["return", 180, null]);
  expect(levels(dragged(steps, 0, 90, 0.015))).toEqual([0, 0.015, 0.02, 0]);
  expect(levels(dragged(steps, 0, 90, 0.025))).toEqual(levels(steps));
});

test("the core is asked in SI units, and only for the sizes of the follower", () => {
  const of = asked({ ...sizes.value, motion: "oscillating", follower: "flat", offset: 0.1, face: 0.002 }, [
    { way: "rise", angle: 180, height: 15, law: "poly345" },
  ]);
  expect(of).toMatchObject({ offset: 0, roller_radius: 0, arm: 0.07, pivot: [0.08, 0.01], face: 0.002 });
  expect(of.programme[0]!.angle).toBeCloseTo(Math.PI, 15);
  expect(of.programme[0]!.lift).toBeCloseTo(Math.PI / 12, 15);
  expect(asked(sizes.value, TURN)).toMatchObject({ arm: null, pivot: null, face: 0, roller_radius: 0.008 });
});
