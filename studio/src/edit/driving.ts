// Linear laws of drivers: the present value of a quantity plus a speed times t. The speed is a parameter.
import { entries, freeName, mentions } from "../catalogue/tree";
import type { Change, Parameter, Tree, Value } from "../core/protocol";
import { isRate, type Prescribed, prescribed, rateOf } from "./start";

/** A position quantity at the start. */
export interface Motion {
  name: string;
  /** m or rad. */
  unit: string;
  /** Its value at the start. */
  value: number;
  /** Its rate at the start. */
  rate: number;
  /** Whether the mechanism has no other freedom. */
  alone: boolean;
}

/** A number that a unit may follow, as the core reads it. */
const WITH_UNIT = /^([-+]?[\d.]+(?:e[-+]?\d+)?)\s*([A-Za-z].*)$/i;
const RPM = "10 rpm";

/**
 * The law, and the changes that it needs. They add its parameter, and remove prescribed rates of the start, which would
 * contradict another speed.
 */
export function evenLaw(
  motion: Motion,
  { length, degrees }: { length: number; degrees: boolean },
  tree: Tree | null,
): { law: string; changes: Change[] } {
  const set = prescribed(tree);
  const own = rateOf(motion.name);
  const rates = set.filter(({ name }) => name === own || (motion.alone && isRate(name)));
  const speed = freeName(tree, "speed");
  const begin = beginOf(set.find(({ name }) => name === motion.name)) ?? String(motion.value);
  const value = speedOf(motion, rates.find(({ name }) => name === own)?.value) ?? firstSpeed(motion, length, degrees);
  return {
    law: `${begin} + ${speed}*t`,
    changes: [
      ...rates.map(({ path }): Change => ({ path, remove: true })),
      { path: ["parameters", speed], value: value },
    ],
  };
}

/** A prescribed value of the start as a part of a formula, with a unit as a factor; undefined if that is impossible. */
function beginOf(found: Prescribed | undefined): string | undefined {
  if (!found || typeof found.value === "object") return undefined;
  const text = String(found.value).trim();
  const [, number, unit] = WITH_UNIT.exec(text) ?? [];
  if (!unit) return text;
  return unit === "deg" ? `${number}*deg` : undefined;
}

/** The rate at the start as it is written, with its unit; undefined at rest. */
function speedOf({ rate, unit }: Motion, written: Value | undefined): Value | undefined {
  if (!rate) return undefined;
  if (typeof written === "string") return written;
  return `${written ?? Number(rate.toPrecision(6))} ${unit}/s`;
}

function firstSpeed({ unit }: Motion, length: number, degrees: boolean): string {
  if (unit === "rad") return degrees ? RPM : "1 rad/s";
  const speed = Number(length.toPrecision(1));
  return speed < 1 ? `${Number((1000 * speed).toPrecision(1))} mm/s` : `${speed} m/s`;
}

/** A parameter that is the speed of a driver. */
export interface Speed {
  driver: string;
  parameter: string;
  value: number;
  /** rad/s or m/s. */
  unit: string;
}

/** The parameters that are speeds in the laws of drivers: by their dimension, or as factors of the time. */
export function speedsOf(tree: Tree | null, parameters: readonly Parameter[]): Speed[] {
  return Object.entries(entries(tree, "drivers")).flatMap(([driver, fields]) =>
    parameters
      .filter(({ name, unit }) => mentions(fields, name) && (unit ? unit in SPEEDS : isFactor(fields, name)))
      .map(({ name, value, unit }) => ({
        driver,
        parameter: name,
        value,
        unit: SPEEDS[unit ?? ""] ?? (String(fields.coordinate).endsWith("angle") ? "rad/s" : "m/s"),
      })),
  );
}

/** Dimensions of speeds as the core writes them, and their units. */
const SPEEDS: Record<string, string> = { "s^-1": "rad/s", "rad/s": "rad/s", "m*s^-1": "m/s", "m/s": "m/s" };

function isFactor(fields: Tree, name: string): boolean {
  const own = new RegExp(`(?<![\\w.])(?:${name}\\s*\\*\\s*t|t\\s*\\*\\s*${name})(?!\\w)`);
  return Object.values(fields).some((one) => typeof one === "string" && own.test(one));
}
