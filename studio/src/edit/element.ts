// The change of the text that adds an element with initial values.
import type { Field } from "../catalogue/catalogue";
import type { Tool } from "../catalogue/tools";
import { freeName } from "../catalogue/tree";
import type { Change, Tree, Value } from "../core/protocol";
import type { Added } from "./adding";
import { evenLaw, type Motion } from "./driving";

/** The source of initial values: measures of the drawing, and the clicked coordinates. */
export interface Scale {
  /** The distance of the clicked places, otherwise a length of the drawing, m. */
  length: number;
  /** The size of the mechanism, m, and the mass and weight of its bodies. */
  size: number;
  mass: number;
  weight: number;
  /** The angle of body j relative to body i. */
  turn: number;
  /** The distance of the second place from the line of the first one, to its left, m; 0 without a line. */
  beside: number;
  /** The offset with which two wheels keep their drawn positions; 0 for other elements. */
  offset: number;
  /** Whether the chosen joint is a pin. */
  pin: boolean;
  /** Whether the display has degrees and rpm. */
  degrees: boolean;
  now: readonly Motion[];
}

/** An element whose references have been chosen. */
export function addElement(
  { group, type, stem }: Tool,
  chosen: Record<string, Value>,
  scale: Scale,
  tree: Tree | null,
): Added {
  const name = freeName(tree, stem);
  const value: Tree = { type: type.name };
  const changes: Change[] = [];
  const isSum = type.fields.some(({ shape }) => shape === "terms");
  const [first] = scale.now;
  for (const field of type.fields) {
    const useful = field.name in chosen ? chosen[field.name] : usefulValue(field, scale);
    if (useful !== undefined) value[field.name] = useful;
    else if (field.required && isOfCoordinate(field) && first && group === "drivers") {
      const even = evenLaw(first, scale, tree);
      value[field.name] = even.law;
      changes.push(...even.changes);
    } else if (field.required) value[field.name] = startingValue(field, scale);
    else if (isSum && isOfCoordinate(field)) value[field.name] = sum(scale.now);
  }
  return { changes: [...changes, { path: [group, name], value }], name };
}

/** The damping ratio of a new spring. */
const DAMPING = 0.05;

/** The stiffness at which the weight moves a spring by a tenth of the mechanism, or turns it by a fifth of a radian. */
function stiffness({ weight, size }: Scale, unit: string): number {
  return unit.includes("rad") ? 5 * weight * size : (10 * weight) / size;
}

/** The damping of such a spring with the mass of the mechanism. */
function damping(scale: Scale, unit: string): number {
  const inertia = unit.includes("rad") ? (scale.mass * scale.size ** 2) / 12 : scale.mass;
  return 2 * DAMPING * Math.sqrt(stiffness(scale, unit) * inertia);
}

/** The radius of a new wheel as a share of the distance of the centres: gears touch each other, belts have room. */
export function wheelShare(required: boolean): number {
  return required ? 1 / 4 : 1 / 2;
}

/** Values with which a new element works, by the names of their fields. */
const USEFUL: Record<string, (scale: Scale, field: Field) => Value | undefined> = {
  free_length: ({ length }) => digits(length, 4),
  free_angle: ({ turn }) => digits(turn, 4),
  angle: ({ turn }) => digits(turn, 9) || undefined, // of a weld
  stiffness: (scale, { unit, shape }) =>
    unit === "any"
      ? digits(scale.weight / (scale.size / 200) ** 1.5, 1) // a contact; the weight presses in by a 200th of the size
      : shape === "triple"
        ? unit.split(",").map((one) => digits(10 * stiffness(scale, one), 1))
        : shape === "law"
          ? digits(stiffness(scale, unit), 1)
          : undefined, // a belt is not elastic
  damping: (scale, { unit, shape }) =>
    shape === "law" || shape === "number"
      ? unit.startsWith("N")
        ? digits(damping(scale, unit), 1)
        : undefined
      : undefined,
  radii: ({ length }, { required }) => {
    const radius = digits(length * wheelShare(required), 9);
    return [radius, radius];
  },
  // wheels stay where they are drawn
  offset: ({ offset }) => (offset ? digits(offset, 9) : undefined),
  radius: ({ beside, size, pin }, field) =>
    field.required ? digits(beside || size / 20, 6) : pin && isAbsent(field) ? digits(size / 50, 1) : undefined,
  clearance: ({ size }) => digits(size / 400, 1),
  kinetic: () => 0.2,
  torque: ({ weight, size }) => digits((weight * size) / 10, 1),
  force: ({ weight }, { shape }) => (shape === "law_pair" ? [digits(weight / 5, 1), 0] : digits(weight / 5, 1)),
  stall_torque: ({ weight, size }) => digits(weight * size, 1),
  free_speed: () => "100 rpm",
  lower: (scale) => limit(scale, -1),
  upper: (scale) => limit(scale, 1),
};

function usefulValue(field: Field, scale: Scale): Value | undefined {
  return USEFUL[field.name]?.(scale, field);
}

function limit({ now: [motion], size }: Scale, side: number): Value | undefined {
  return motion && digits(motion.value + side * (motion.unit === "rad" ? 1 : size / 5), 3);
}

function isAbsent({ default: value }: Field): boolean {
  return typeof value === "object" && value !== null && "absent" in value;
}

function digits(value: number, count: number): number {
  return Number(value.toPrecision(count)) + 0;
}

/** Whether a field is the law of a position quantity. */
function isOfCoordinate({ shape, unit }: Field): boolean {
  return shape === "law" && unit.includes("|") && unit.includes("rad");
}

/** Factors of coordinates: 1 for the first, -1 for the others. */
function factor(k: number): number {
  return k ? -1 : 1;
}

function sum(now: readonly Motion[]): number {
  return Number(now.reduce((all, { value }, k) => all + factor(k) * value, 0).toPrecision(12));
}

/** An initial value for a required field. */
function startingValue({ shape, unit }: Field, { length, now }: Scale): Value {
  const one = unit === "m" ? Number(length.toPrecision(4)) : 1;
  if (shape === "pair" || shape === "law_pair") return [one, one];
  if (shape === "terms") return Object.fromEntries(now.map(({ name }, k) => [name, factor(k)]));
  if (shape === "laws") return now.map(({ name, value }) => `${name} - (${Number(value.toPrecision(12))})`);
  if (shape === "units") return now.map((of) => of.unit);
  if (typeof shape === "object" && "words" in shape) return shape.words[0]!;
  return one;
}
