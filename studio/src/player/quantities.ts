// The quantities for plots: those that follow from the frames, and the channels of the scene.
import { type Point, placed } from "../plane/points";
import { playerTexts as texts } from "../texts";
import { SceneCurve, type Source } from "./curve";
import { acceleration, type Instant, type Motion, velocity } from "./motion";
import { naturalScales } from "./scales";
import type { Channel, Scene } from "./scene";

/** Curves that can be plotted together. */
export interface Quantity {
  key: string;
  group: string;
  name: string;
  symbol: string;
  curves: SceneCurve[];
  /** Named sets of several curves; by default, one set of all curves. */
  sets?: [string, SceneCurve[]][];
}

const ORIGIN: Point = [0, 0];
/** Below this share of the natural scale, a number is a rounding error. */
const NOISE = 5e-9;

/** Quantities of bodies that turn, each before its derivative. */
const TURNING = [
  { key: "angle", symbol: "φ", unit: "angle", rows: "poses" },
  { key: "omega", symbol: "ω", unit: "angular_velocity", rows: "rates" },
  { key: "alpha", symbol: "α", unit: "angular_acceleration", rows: "accelerations" },
] as const;

/** Quantities of points: order of the derivative, component (none for the magnitude), key of the rate. */
const MOVING = [
  { key: "x", symbol: "x", unit: "length", order: 0, component: 0, rate: "vx" },
  { key: "y", symbol: "y", unit: "length", order: 0, component: 1, rate: "vy" },
  { key: "vx", symbol: "vx", unit: "velocity", order: 1, component: 0, rate: "ax" },
  { key: "vy", symbol: "vy", unit: "velocity", order: 1, component: 1, rate: "ay" },
  { key: "speed", symbol: "|v|", unit: "velocity", order: 1, component: null, rate: null },
  { key: "ax", symbol: "ax", unit: "acceleration", order: 2, component: 0, rate: null },
  { key: "ay", symbol: "ay", unit: "acceleration", order: 2, component: 1, rate: null },
  { key: "acceleration", symbol: "|a|", unit: "acceleration", order: 2, component: null, rate: null },
] as const;

const DERIVATIVES = [(now: Instant, body: number, at: Point) => placed(now.poses[body]!, at), velocity, acceleration];
/** Symbols of the forces of elements and joints. */
const ACTING = { force: "|F|", force_x: "Fx", force_y: "Fy", torque: "T" } as const;
/** Symbols of the other channels. */
const OF_SCENE = { coordinates: "u", states: "z", energy: "E", accuracy: "|Φ|" } as const;

/** All quantities, those without curves left out. */
export function quantities(scene: Scene, motion: Motion): Quantity[] {
  const all = [
    ...ofBodies(scene, motion),
    ...ofPoints(scene, motion),
    ...ofElements(scene, motion, "reactions"),
    ...ofElements(scene, motion, "forces"),
    ...Object.keys(OF_SCENE).flatMap((group) => ofScene(scene, motion, group as keyof typeof OF_SCENE)),
  ].filter(({ curves }) => curves.length);
  const scales = naturalScales(scene);
  for (const { group, curves } of all) {
    const exact = group === texts.groups.accuracy;
    for (const curve of curves) curve.noise = exact ? 0 : NOISE * (scales[curve.unit] ?? 0);
  }
  return all;
}

function ofBodies(scene: Scene, motion: Motion): Quantity[] {
  const turning = scene.bodies.filter(({ number, kind }) => number > 0 && kind !== "point_mass");
  let rates: SceneCurve[] = [];
  const made = [...TURNING].reverse().map(({ key, symbol, unit, rows }): Quantity => {
    const curves = turning.map(({ name, number }, k) => {
      const sample = (frame: number) => scene.frames[rows][frame]![number - 1]![2];
      const source = { subject: name, key, unit: scene.units[unit], number: number - 1, sample, rate: rates[k] };
      return new SceneCurve(motion, source);
    });
    rates = curves;
    return { key, group: texts.groups.bodies, name: texts.turning[key], symbol, curves };
  });
  return made.reverse();
}

interface Moving {
  name: string;
  body: number;
  at: Point;
  number: number;
}

/** The origins of all moving bodies, and their named points. */
function movingPoints({ bodies }: Scene): [Moving[], Moving[]] {
  const moving = bodies.filter(({ number }) => number > 0);
  const origins = moving.map(({ name, number }) => ({ name, body: number, at: ORIGIN, number: number - 1 }));
  const named = moving.flatMap(({ name, number, points }) =>
    points.map((point) => ({ name: `${name}.${point.name}`, body: number, at: point.at })),
  );
  return [origins, named.map((point, k) => ({ ...point, number: k }))];
}

function ofPoints(scene: Scene, motion: Motion): Quantity[] {
  const [origins, named] = movingPoints(scene);
  const made = new Map<string, SceneCurve>();
  const quantity = ({ key, symbol, unit, order, component, rate }: (typeof MOVING)[number]): Quantity => {
    const curves = [...origins, ...named].map(({ name, body, at, number }) => {
      const sample = (k: number) => {
        const value = DERIVATIVES[order]!(motion.frame(k), body, at);
        return component === null ? Math.hypot(...value) : value[component];
      };
      const curve = new SceneCurve(motion, {
        subject: name,
        key,
        unit: scene.units[unit],
        number,
        sample,
        rate: made.get(`${name}.${rate}`),
      });
      made.set(curve.name, curve);
      return curve;
    });
    const sets: [string, SceneCurve[]][] = [
      [texts.allBodies, curves.slice(0, origins.length)],
      [texts.allPoints, curves.slice(origins.length)],
    ];
    return { key, group: texts.groups.points, name: texts.moving[key], symbol, curves, sets };
  };
  return [...MOVING].reverse().map(quantity).reverse();
}

/** Forces and torques of joints, drivers and force elements on their body j. */
function ofElements(scene: Scene, motion: Motion, group: "reactions" | "forces"): Quantity[] {
  const { reactions } = scene.frames;
  const ofJoint: Record<string, (force: Point) => number> = {
    force: (force) => Math.hypot(...force),
    force_x: ([x]) => x,
    force_y: ([, y]) => y,
  };
  return Object.entries(ACTING).map(([key, symbol]) => {
    const unit = key === "torque" ? scene.units.torque : scene.units.force;
    const part = ofJoint[key];
    const joints = group === "reactions" && part ? scene.joints : [];
    const sources = joints.map((joint, k): Source => {
      return { subject: joint.name, key, unit, number: k, sample: (frame) => part!(reactions[frame]![k]!) };
    });
    const channels = scene.channels.filter((channel) => channel.group === group && channel.quantity === key);
    sources.push(...channels.map((channel, k) => ofChannel(channel, joints.length + k)));
    const name = texts.acting[group](texts.parts[key as keyof typeof ACTING]);
    const curves = sources.map((source) => new SceneCurve(motion, source));
    return { key: `${group}.${key}`, group: texts.groups[group], name, symbol, curves };
  });
}

/** Channels of a group, one quantity for each unit. */
function ofScene(scene: Scene, motion: Motion, group: keyof typeof OF_SCENE): Quantity[] {
  const channels = scene.channels.filter((channel) => channel.group === group);
  const units = [...new Set(channels.map(({ unit }) => unit))];
  return units.map((unit) => {
    const listed = channels.filter((channel) => channel.unit === unit);
    const curves = listed.map((channel, k) => new SceneCurve(motion, ofChannel(channel, k)));
    const name = units.length > 1 ? `${texts.channels[group]} / ${unit}` : texts.channels[group];
    return { key: `${group}.${unit}`, group: texts.groups[group], name, symbol: OF_SCENE[group], curves };
  });
}

function ofChannel({ name, of, quantity, unit, values }: Channel, number: number): Source {
  return { subject: of || name, key: of ? quantity : "", unit, number, sample: (k) => values[k]! };
}

/** The places in the lists of the angle, or else of a coordinate, of the driven body that moves; otherwise of all angles. */
export function drivenMotion({ symbols, bodies }: Scene, all: readonly Quantity[]): readonly [number, number] {
  const drives = symbols.filter(({ mark }) => mark.startsWith("drive"));
  const driven = drives.flatMap((drive) => drive.bodies.filter((body) => body > 0).map((body) => bodies[body]!.name));
  for (const key of driven.length ? ["angle", "x", "y"] : []) {
    const which = all.findIndex((one) => one.key === key);
    const lists = which < 0 ? [] : choices(all[which]!);
    const whose = lists.findIndex(
      ({ curves }) => curves.length === 1 && driven.includes(curves[0]!.subject) && moves(curves[0]!),
    );
    if (whose >= 0) return [which, whose];
  }
  return [0, 0];
}

function moves({ values, noise }: SceneCurve): boolean {
  return Math.max(...values) - Math.min(...values) > noise;
}

/** The choices of a quantity: all curves together, and each one alone. */
export function choices({ curves, sets = [[texts.all, curves]] }: Quantity): { name: string; curves: SceneCurve[] }[] {
  const subjects = new Set(curves.map(({ subject }) => subject));
  const together = sets
    .filter(([, members]) => members.length > 1)
    .map(([name, members]) => ({ name, curves: members }));
  const name = (curve: SceneCurve) => (subjects.size === curves.length ? curve.subject : curve.name);
  return [...together, ...curves.map((curve) => ({ name: name(curve), curves: [curve] }))];
}
