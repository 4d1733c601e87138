import { expect, test } from "vitest";
import { displayed } from "../src/draw/display";
import { quantity, scaled, withUnit } from "../src/draw/numbers";

const MM = { degrees: true, length: "mm" } as const;
const SI = { degrees: false, length: "m" } as const;

test("units of length, and of their rates, follow the choice; others do not", () => {
  const units = ["m", "m/s", "m/s^2", "N*m", "m^2", "mol", "kg*m^2", "rad", "rad/s"];
  const shown = ["mm", "mm/s", "mm/s^2", "N*m", "m^2", "mol", "kg*m^2", "°", "rpm"];
  expect(units.map((unit) => displayed(unit, MM).unit)).toEqual(shown);
  expect(units.map((unit) => displayed(unit, SI).unit)).toEqual(units);
  expect(displayed("m/s", MM).factor).toBe(1000);
  expect(displayed("m^2", MM).factor).toBe(1);
});

test("rates over a quantity follow the units of both", () => {
  const units = ["m/rad", "m/rad^2", "rad/rad", "rad/m", "J/rad", "m/rad²", "m/m"];
  const shown = ["mm/°", "mm/°^2", "°/°", "°/mm", "J/°", "mm/°²", "mm/mm"];
  expect(units.map((unit) => displayed(unit, MM).unit)).toEqual(shown);
  expect(units.map((unit) => displayed(unit, SI))).toEqual(units.map((unit) => ({ factor: 1, unit })));
  expect(displayed("m/rad", MM).factor).toBeCloseTo((1000 * Math.PI) / 180, 9);
  expect(displayed("m/rad^2", MM).factor).toBeCloseTo(1000 * (Math.PI / 180) ** 2, 9);
  expect(displayed("m/rad²", MM).factor).toBeCloseTo(1000 * (Math.PI / 180) ** 2, 9);
  expect(displayed("rad/rad", MM).factor).toBe(1);
});

test("numbers in mm have no other prefix", () => {
  expect(withUnit(1234.5, "mm")).toBe("1235 mm");
  expect(quantity(4321, "mm/s^2")).toBe("4321 mm/s²");
  expect(scaled(40000, "mm")).toEqual({ factor: 1, unit: "mm" });
  expect(scaled(0.04, "m")).toEqual({ factor: 1e-3, unit: "mm" });
});
