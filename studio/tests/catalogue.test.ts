import { expect, test } from "vitest";
import { readCatalogue, type Type, typeOf } from "../src/catalogue/catalogue";
import { toolsOf } from "../src/catalogue/tools";
import { freeName, freePointNames, mentions } from "../src/catalogue/tree";

function type(name: string, fields: [string, string, boolean][]): Type {
  const made = fields.map(([field, shape, required]) => ({
    name: field,
    shape,
    required,
    unit: "",
    default: null,
    doc: "",
  }));
  return { name, doc: "", fields: made };
}

test("what a tool needs follows from the fields", () => {
  const catalogue = readCatalogue({
    bodies: [
      type("link", [
        ["ends", "names", false],
        ["through", "points", false],
      ]),
      type("plate", [
        ["points", "points", false],
        ["through", "points", false],
        ["mass", "number", false],
      ]),
      type("spot", [
        ["mass", "number", true],
        ["at", "pair", false],
      ]),
      type("ground", [["points", "points", false]]),
    ],
    elements: {
      forces: [
        type("push", [
          ["j", "body", true],
          ["torque", "law", true],
          ["i", "body", false],
        ]),
      ],
    },
  });
  const tools = toolsOf(catalogue);
  expect(tools.map(({ placing }) => placing)).toEqual(["two", "many", "one", "fixed", null, "slider", "cylinder"]);
  expect(tools[4]!.references.map(({ name }) => name)).toEqual(["j"]);
});

test("a body without a type has the first one, ground its own", () => {
  const catalogue = readCatalogue({ bodies: [type("body", []), type("ground", [])] });
  expect(typeOf(catalogue, "bodies", "arm", {})?.name).toBe("body");
  expect(typeOf(catalogue, "bodies", "ground", {})?.name).toBe("ground");
});

test("free names avoid all that is defined", () => {
  const tree = { bodies: { bar1: {} }, joints: { A: {}, bar2: {} }, parameters: { bar3: 1 } };
  expect(freeName(tree, "bar")).toBe("bar4");
  expect(freePointNames(tree, ["B"], 2)).toEqual(["C", "D"]);
  expect(freePointNames({}, [..."ABCDEFGHIJKLMNOPQRSTUVWXYZ"], 1)).toEqual(["A2"]);
});

test("a name is mentioned as a whole word that no dot precedes", () => {
  expect(mentions({ i: "crank.A" }, "crank")).toBe(true);
  expect(mentions({ value: "2*crank.angle + t" }, "crank")).toBe(true);
  expect(mentions({ value: "crank2.angle" }, "crank")).toBe(false);
  expect(mentions({ i: "arm.crank" }, "crank")).toBe(false);
  expect(mentions({ terms: { "crank.angle": 2 } }, "crank")).toBe(true);
});
