import { expect, test } from "vitest";
import { type Catalogue, readCatalogue } from "../src/catalogue/catalogue";
import { toolsOf } from "../src/catalogue/tools";
import type { Body, Tree } from "../src/core/protocol";
import { addBody, pointReference } from "../src/edit/adding";
import { evenLaw, speedsOf } from "../src/edit/driving";
import { addElement } from "../src/edit/element";
import { drawnThrough, moved } from "../src/edit/moving";
import { removed, removedPoint, renamed } from "../src/edit/removing";
import { typed, typedList, written, writtenList } from "../src/edit/values";
import { allPoints } from "../src/plane/hits";
import { inFrame, placed } from "../src/plane/points";

const MEASURES = { length: 1, size: 1, mass: 1, weight: 10, turn: 0, offset: 0, beside: 0, pin: false, degrees: true };

const field = (name: string, shape: string, unit = "", required = false) => ({
  name,
  shape,
  unit,
  required,
  default: null,
  doc: "",
});
const catalogue: Catalogue = readCatalogue({
  bodies: [
    {
      name: "rod",
      doc: "",
      fields: [field("mass", "number", "kg", true), field("ends", "names"), field("through", "points", "m")],
    },
    { name: "ground", doc: "", fields: [field("points", "points", "m")] },
  ],
  joints: [
    {
      name: "hinge",
      doc: "",
      fields: [field("i", "point", "", true), field("j", "point", "", true)],
      joins_points: true,
    },
  ],
  drivers: [
    {
      name: "drive",
      doc: "",
      fields: [field("coordinate", "coordinate", "", true), field("value", "law", "m|rad", true)],
    },
  ],
});
const [rod, ground, hinge, drive] = toolsOf(catalogue) as [
  ReturnType<typeof toolsOf>[0],
  ReturnType<typeof toolsOf>[0],
  ReturnType<typeof toolsOf>[0],
  ReturnType<typeof toolsOf>[0],
];

const body = (name: string, points: Body["points"], isGround = false): Body => ({
  name,
  kind: "",
  ground: isGround,
  points,
  center: [0, 0],
  mass: 1,
  inertia: 1,
});
const bodies = [body("ground", { A: [0, 0], D: [4, 0] }, true), body("crank", { A: [-1, 0], B: [1, 0] })];
const poses: [number, number, number][] = [
  [0, 0, 0],
  [0, 1, Math.PI / 2],
];
const tree: Tree = {
  bodies: { ground: { points: { A: [0, 0], D: ["G", 0] } }, crank: { type: "rod", through: { A: [0, 0], B: [0, 2] } } },
  joints: { A: { type: "hinge", i: "ground.A", j: "crank.A" } },
  forces: { rub: { type: "friction", joint: "A" }, push: { type: "torque", j: "crank", torque: "-crank.omega" } },
  start: { set: { "crank.angle": 1 } },
};

test("a rod from a free point to a pin takes the name of the pin and gets a joint there", () => {
  const hits = allPoints(bodies, poses).filter(({ point }) => point === "B");
  const { changes, name } = addBody(
    rod,
    [
      { at: [0, 2], hits },
      { at: [3, 3], hits: [] },
    ],
    catalogue,
    { tree, bodies, poses },
  );
  expect(name).toBe("rod1");
  expect(changes).toEqual([
    { path: ["bodies", "rod1"], value: { type: "rod", mass: 1, through: { B: [0, 2], C: [3, 3] } } },
    { path: ["joints", "B"], value: { type: "hinge", i: "crank.B", j: "rod1.B" } },
  ]);
});

test("a second joint at a pin gets a name of its own", () => {
  const hits = allPoints(bodies, poses).filter(({ point }) => point === "A");
  const { changes } = addBody(
    rod,
    [
      { at: [0, 0], hits },
      { at: [3, 3], hits: [] },
    ],
    catalogue,
    { tree, bodies, poses },
  );
  expect(changes[1]).toEqual({ path: ["joints", "A1"], value: { type: "hinge", i: "ground.A", j: "rod1.A" } });
});

test("a fixed point is added to ground, also where there is none yet", () => {
  const place = [{ at: [5, 1] as [number, number], hits: [] }];
  expect(addBody(ground, place, catalogue, { tree, bodies, poses }).changes).toEqual([
    { path: ["bodies", "ground", "points", "C"], value: [5, 1] },
  ]);
  expect(addBody(ground, place, catalogue, { tree: {}, bodies: [], poses: [] }).changes).toEqual([
    { path: ["bodies", "ground"], value: { points: { A: [5, 1] } } },
  ]);
});

test("a reference to a place on a body makes a point in its frame", () => {
  const plain: Tree = { bodies: { crank: { type: "rod", length: 2, ends: ["A", "B"] } } };
  const found = pointReference({ at: [0.5, 1], hits: [] }, bodies[1]!, { tree: plain, bodies, poses }, []);
  expect(found.reference).toBe("crank.C");
  const [change] = found.changes as { path: string[]; value: Record<string, [number, number]> }[];
  expect(change!.path).toEqual(["bodies", "crank", "points"]);
  expect(placed(poses[1]!, change!.value.C!)[0]).toBeCloseTo(0.5, 12);
});

test("a body that is placed by its points gets another place, as it was drawn", () => {
  const moved: [number, number, number][] = [poses[0]!, [2, 0, 0]];
  const found = pointReference({ at: [2.5, 0.3], hits: [] }, bodies[1]!, { tree, bodies, poses: moved }, []);
  expect(found.changes).toEqual([{ path: ["bodies", "crank", "through", "C"], value: [-0.3, 1.5] }]);
});

test("a driver begins at the present value of its quantity, with all digits, and has a parameter for its speed", () => {
  const motion = { name: "crank.angle", unit: "rad", value: 1 / 3, rate: 0, alone: true };
  const chosen = { coordinate: "crank.angle" };
  const { changes } = addElement(drive, chosen, { ...MEASURES, length: 1, now: [motion] }, {});
  expect(changes).toEqual([
    { path: ["parameters", "speed1"], value: "10 rpm" },
    {
      path: ["drivers", "drive1"],
      value: { type: "drive", ...chosen, value: "0.3333333333333333 + speed1*t" },
    },
  ]);
  const sliding = { name: "block.x", unit: "m", value: 0.25, rate: 0, alone: true };
  const [speed] = addElement(drive, chosen, { ...MEASURES, length: 0.05, now: [sliding] }, tree).changes;
  expect(speed).toEqual({ path: ["parameters", "speed1"], value: "50 mm/s" });
  expect(hinge.references.length).toBe(2);
});

test("a driver takes over what the start prescribes of its quantity", () => {
  const scale = { length: 1, degrees: true };
  const motion = { name: "crank.angle", unit: "rad", value: Math.PI / 3, rate: 30, alone: true };
  const start = (set: Tree): Tree => ({ start: { set } });
  const law = (set: Tree, more = {}) => evenLaw({ ...motion, ...more }, scale, start(set));
  expect(law({ "crank.angle": "60*deg", "crank.omega": 30 })).toEqual({
    law: "60*deg + speed1*t",
    changes: [
      { path: ["start", "set", "crank.omega"], remove: true },
      { path: ["parameters", "speed1"], value: "30 rad/s" },
    ],
  });
  expect(law({ crank: { angle: "60 deg", omega: "w" } })).toEqual({
    law: "60*deg + speed1*t",
    changes: [
      { path: ["start", "set", "crank", "omega"], remove: true },
      { path: ["parameters", "speed1"], value: "w" },
    ],
  });
  // Another unit cannot be written in a formula; the rate of another body contradicts only where there is one freedom.
  expect(law({ "crank.angle": "1 rad", "rod.omega": 2 }).law).toBe(`${motion.value} + speed1*t`);
  expect(law({ "rod.omega": 2 }).changes.length).toBe(2);
  expect(law({ "rod.omega": 2 }, { alone: false }).changes.length).toBe(1);
});

test("speeds are found in the laws of drivers by their dimension, or as factors of the time", () => {
  const laws: Tree = {
    drivers: {
      a: { coordinate: "crank.angle", value: "70*deg + w*t + 0*L" },
      b: { coordinate: "block.x", value: "u*(t - 1)" },
      c: { coordinate: "crank.angle", value: "n*t*k" },
    },
  };
  const all = [
    { name: "w", value: 2, unit: "s^-1" },
    { name: "u", value: 0.1, unit: "m*s^-1" },
    { name: "L", value: 1, unit: "m" },
    { name: "n", value: 3, unit: null },
    { name: "k", value: 4, unit: null },
  ];
  expect(speedsOf(laws, all).map(({ driver, parameter, unit }) => [driver, parameter, unit])).toEqual([
    ["a", "w", "rad/s"],
    ["b", "u", "m/s"],
    ["c", "n", "rad/s"],
    ["c", "k", "rad/s"],
  ]);
});

test("all that is pinned at a place moves with it", () => {
  const hits = allPoints(bodies, poses).filter(({ point }) => point === "A");
  expect(moved(tree, hits, poses, bodies, [1, 0.5])).toEqual({
    changes: [
      { path: ["bodies", "ground", "points", "A"], value: [1, 0.5] },
      { path: ["bodies", "crank", "through", "A"], value: [1, 0.5] },
    ],
    fixed: [],
  });
});

test("a point that a formula gives is not moved", () => {
  const hits = allPoints(bodies, poses).filter(({ point }) => point === "D");
  expect(moved(tree, hits, poses, bodies, [1, 0.5])).toEqual({ changes: [], fixed: [{ body: "ground", point: "D" }] });
});

test("a bar of a given length can be placed by its points instead", () => {
  const other = { bodies: { crank: { type: "rod", length: "L", ends: ["A", "B"] } } };
  const changes = drawnThrough(other, allPoints(bodies, poses), "crank");
  expect(changes.slice(0, 2)).toEqual([
    { path: ["bodies", "crank", "length"], remove: true },
    { path: ["bodies", "crank", "ends"], remove: true },
  ]);
  expect(changes[2]).toEqual({ path: ["bodies", "crank", "through"], value: { A: [0, 0], B: [0, 2] } });
});

test("what cannot be without a removed body is removed with it", () => {
  const paths = removed(tree, "bodies", "crank").map(({ path }) => path.join("."));
  expect(paths.sort()).toEqual(["bodies.crank", "forces.push", "forces.rub", "joints.A", "start.set.crank.angle"]);
});

test("a removed point takes its joints along", () => {
  const paths = removedPoint(tree, "ground", "A").map(({ path }) => path.join("."));
  expect(paths.sort()).toEqual(["bodies.ground.points.A", "forces.rub", "joints.A"]);
});

test("a renamed body is renamed wherever it is mentioned", () => {
  expect(renamed(tree, "bodies", "crank", "arm")).toEqual([
    { path: ["joints", "A", "j"], value: "arm.A" },
    { path: ["forces", "push", "j"], value: "arm" },
    { path: ["forces", "push", "torque"], value: "-arm.omega" },
    { path: ["start", "set", "crank.angle"], rename: "arm.angle" },
    { path: ["bodies", "crank"], rename: "arm" },
  ]);
  const list = { measures: { m: ["crank.x", ["2*crank.y"]] } };
  expect(renamed(list, "bodies", "crank", "arm")[0]).toEqual({
    path: ["measures", "m"],
    value: ["arm.x", ["2*arm.y"]],
  });
});

test("typed values are numbers, formulas or lists", () => {
  expect(typed(" 2.5e-3 ")).toBe(0.0025);
  expect(typed("30 deg")).toBe("30 deg");
  expect(typed("L1/2")).toBe("L1/2");
  expect(typed("")).toBeUndefined();
  expect(typedList('[0, "L/2"]')).toEqual([0, "L/2"]);
  expect(typedList("max(1, 2), 3")).toEqual(["max(1, 2)", 3]);
  expect(writtenList([0, "L/2"])).toBe("0, L/2");
  expect(written({ a: [1, "x"] })).toBe('{ a = [1, "x"] }');
});

test("a frame and its inverse", () => {
  const [x, y] = inFrame([1, 2, 0.3], placed([1, 2, 0.3], [0.4, -0.7]));
  expect([x, y]).toEqual([expect.closeTo(0.4, 14), expect.closeTo(-0.7, 14)]);
});
