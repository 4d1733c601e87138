import { unzipSync } from "fflate";
import { expect, test } from "vitest";
import { npy, npz } from "../src/give/npz";
import { csv } from "../src/give/table";

test("an array of NumPy has its head, its shape and its numbers", () => {
  const bytes = npy({ shape: [2, 2], values: new Float64Array([1, 2, 3, -0.5]) });
  const head = new TextDecoder("latin1").decode(bytes.subarray(0, 128));
  expect(head.startsWith("\x93NUMPY\x01\x00")).toBe(true);
  expect(head).toContain("'shape': (2, 2)");
  expect(bytes.length % 64).toBe(32);
  expect(new DataView(bytes.buffer).getFloat64(bytes.length - 8, true)).toBe(-0.5);
  expect(Object.keys(unzipSync(npz({ "a.b": { shape: [1], values: new Float64Array([1]) } })))).toEqual(["a.b.npy"]);
});

test("a table has all digits, and no cell is a formula", () => {
  const text = csv(
    new Float64Array([0, 0.1]),
    ["=evil", 'say "x", y'],
    ["m", "rad"],
    [new Float64Array([1, Number.NaN]), new Float64Array([1 / 3, 2])],
  );
  expect(text.split("\n")).toEqual([
    't [s],\'=evil [m],"say ""x"", y [rad]"',
    "0,1,0.3333333333333333",
    "0.1,nan,2",
    "",
  ]);
});

test("headers of forces over a quantity say what they contain", () => {
  const condition = "with inertia and damping at 1 rad/s";
  const first = { name: "crank.angle", unit: "rad", condition };
  const rows = [0, 1, 2, 3].map((k) => new Float64Array([k]));
  const units = ["m/rad", "N*m", "N·m", "J/rad"];
  const [head] = csv(new Float64Array([0.5]), ["v", "effort", "torque", "power"], units, rows, first).split("\n");
  const marked = ["effort [N*m", "torque [N·m", "power [J/rad"].map((one) => `"${one}, ${condition}]"`);
  expect(head).toBe(["crank.angle [rad]", "v [m/rad]", ...marked].join(","));
});
