import { expect, test } from "vitest";
import { readCatalogue } from "../src/catalogue/catalogue";
import { toolsOf } from "../src/catalogue/tools";
import { curveFor } from "../src/edit/curve";
import { addElement } from "../src/edit/element";
import { isNotation, typeMeant } from "../src/edit/values";

const MEASURES = { length: 1, size: 1, mass: 1, weight: 10, turn: 0, offset: 0, beside: 0, pin: false, degrees: true };

const field = (name: string, shape: string | { options: string }, unit = "", required = true) => ({
  name,
  shape,
  unit,
  required,
  default: null,
  doc: "",
});
const catalogue = readCatalogue({
  joints: [
    { name: "link", doc: "", fields: [field("terms", "terms"), field("value", "law", "m|rad", false)] },
    { name: "zero", doc: "", fields: [field("residual", "laws", "any"), field("units", "units")] },
  ],
});
const now = [
  { name: "a.angle", unit: "rad", value: 0.5, rate: 0, alone: false },
  { name: "b.angle", unit: "rad", value: -0.25, rate: 0, alone: false },
];

test("a relation consists of the coordinates that were clicked, and holds where they are", () => {
  const [link, zero] = toolsOf(catalogue);
  expect(link!.references.map(({ shape }) => shape)).toEqual(["coordinate", "coordinate"]);
  expect(
    addElement(link!, { "terms 1": "a.angle", "terms 2": "b.angle" }, { ...MEASURES, length: 1, now }, null).changes,
  ).toEqual([
    { path: ["joints", "link1"], value: { type: "link", terms: { "a.angle": 1, "b.angle": -1 }, value: 0.75 } },
  ]);
  expect(zero!.references.length).toBe(1);
  expect(addElement(zero!, {}, { ...MEASURES, length: 1, now: now.slice(1) }, null).changes).toEqual([
    { path: ["joints", "zero1"], value: { type: "zero", residual: ["b.angle - (-0.25)"], units: ["rad"] } },
  ]);
});

test("a curve goes around a body; on the ground it goes from right to left under all points", () => {
  const body = { name: "b", kind: "", ground: false, points: {}, center: [0.5, 0] as [number, number] };
  const own = { ...body, mass: 1, inertia: 1 };
  const points: Record<string, [number, number]> = { A: [0, 0], B: [2, 0] };
  const tree = { bodies: { b: { curves: { curve1: {} } } } };
  expect(curveFor(tree, { ...own, points }, 0.2)).toEqual({
    name: "curve2",
    change: { path: ["bodies", "b", "curves", "curve2"], value: { circle: [0.5, 0, 1.5] } },
  });
  expect(curveFor(null, own, 0.2).change).toMatchObject({ value: { circle: [0.5, 0, 0.1] } });
  expect(curveFor(null, { ...own, ground: true, points }, 0.5).change).toMatchObject({
    value: {
      line: [
        [2.5, 0],
        [-0.5, 0],
      ],
    },
  });
});

test("tables, quoted texts and lists of lists are in the notation of the file", () => {
  expect(["{ a = 1 }", " [1]", '"crank"', "'x'"].map((text) => isNotation(text, false))).toEqual(Array(4).fill(true));
  expect(["2*(a + 1)", "800 mm", "crank"].map((text) => isNotation(text, false))).toEqual(Array(3).fill(false));
  expect(["[1, L]", "1, 2", "[[0, 0]]", "{}"].map((text) => isNotation(text, true))).toEqual([
    false,
    false,
    true,
    true,
  ]);
  const method = field("method", { options: "method" });
  expect(typeMeant(method, " rk4 ")).toEqual({ type: "rk4" });
  expect(typeMeant(method, "{ type = 1 }")).toBeUndefined();
  expect(typeMeant(field("end", "number"), "rk4")).toBeUndefined();
});
