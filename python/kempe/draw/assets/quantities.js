// The quantities that can be plotted: those that follow from the frames, and the channels of the scene.
import { acceleration, known, placed, velocity } from "./motion.js";
import { naturalScales } from "./scales.js";

const BODIES = "Bodies";
const POINTS = "Bodies and points";
const ORIGIN = [0, 0];
/** Below this share of the natural scale, a number is a rounding error. */
const NOISE = 5e-9;
/** Quantities of bodies that turn: key, name, symbol, unit, rows of the frames, key of the rate. */
const TURNING = [
  ["angle", "Angle", "φ", "rad", "poses", "omega"],
  ["omega", "Angular velocity", "ω", "rad/s", "rates", "alpha"],
  ["alpha", "Angular acceleration", "α", "rad/s²", "accelerations", null],
];
/** Quantities of points: key, name, symbol, unit, order of the derivative, component, key of the rate. */
const MOVING = [
  ["x", "Position x", "x", "m", 0, 0, "vx"],
  ["y", "Position y", "y", "m", 0, 1, "vy"],
  ["vx", "Velocity x", "vx", "m/s", 1, 0, "ax"],
  ["vy", "Velocity y", "vy", "m/s", 1, 1, "ay"],
  ["speed", "Speed", "|v|", "m/s", 1, null, null],
  ["ax", "Acceleration x", "ax", "m/s²", 2, 0, null],
  ["ay", "Acceleration y", "ay", "m/s²", 2, 1, null],
  ["acceleration", "Acceleration", "|a|", "m/s²", 2, null, null],
];
const DERIVATIVES = [(now, body, point) => placed(now.poses[body], point), velocity, acceleration];
/** Names and symbols of the channels of the scene by group and quantity, and of the forces of joints. */
const ACTING = {
  force: ["force", "|F|"],
  force_x: ["force x", "Fx"],
  force_y: ["force y", "Fy"],
  torque: ["torque", "T"],
};
const OF_SCENE = {
  coordinates: ["Joint coordinates", "Coordinate", "u"],
  states: ["States", "State", "z"],
  energy: ["Energy", "Energy", "E"],
  accuracy: ["Accuracy", "Residual |Φ|", "|Φ|"],
};

/** A quantity over time; its values are computed on first use. */
class Curve {
  constructor(motion, subject, key, unit, look, sample, rate = null) {
    Object.assign(this, { motion, subject, unit, look, sample, rate, name: key ? `${subject}.${key}` : subject, noise: 0 });
  }

  /** Values at the frames, as in the solution. */
  get values() {
    this.kept ??= this.motion.t.map((_, k) => known(this.sample(k)));
    return this.kept;
  }

  get slopes() {
    this.keptSlopes ??= this.rate ? this.rate.values : this.motion.slopes(this.values);
    return this.keptSlopes;
  }

  /** The value at t; rounding errors are shown as zero. */
  at(t) {
    return this.shown(this.motion.value(this, t));
  }

  shown(value) {
    return Math.abs(value) < this.noise ? 0 : value;
  }
}

/** All quantities, `{key, group, name, symbol, curves}`, those without curves left out. */
export function quantities(scene, motion) {
  const all = [
    ...ofBodies(scene, motion),
    ...ofPoints(scene, motion),
    ...ofElements(scene, motion),
    ...Object.keys(OF_SCENE).flatMap((group) => ofScene(scene, motion, group)),
  ].filter(({ curves }) => curves.length);
  const scales = naturalScales(scene);
  for (const { group, curves } of all) {
    for (const curve of curves) curve.noise = group === "Accuracy" ? 0 : NOISE * (scales[curve.unit] ?? 0);
  }
  return all;
}

function ofBodies(scene, motion) {
  const turning = scene.bodies.filter(({ number, kind }) => number > 0 && kind !== "point_mass");
  const made = new Map();
  return [...TURNING].reverse().map(([key, name, symbol, unit, rows, rate]) => {
    const curves = turning.map((body) => {
      const sample = (k) => scene.frames[rows][k][body.number - 1][2];
      const look = body.number - 1;
      const curve = new Curve(motion, body.name, key, unit, look, sample, made.get(`${body.number}.${rate}`));
      made.set(`${body.number}.${key}`, curve);
      return curve;
    });
    return { key, group: BODIES, name, symbol, curves };
  }).reverse();
}

function ofPoints(scene, motion) {
  const moving = scene.bodies.filter(({ number }) => number > 0);
  const origins = moving.map(({ name, number }) => ({ name, number, at: ORIGIN, look: number - 1 }));
  const named = moving.flatMap(({ name, number, points }) => points.map((point) => ({ name: `${name}.${point.name}`, number, at: point.at })));
  const all = [...origins, ...named.map((point, k) => ({ ...point, look: k }))];
  const made = new Map();
  const quantity = ([key, name, symbol, unit, order, component, rate]) => {
    const curves = all.map((point) => {
      const sample = (k) => {
        const value = DERIVATIVES[order](motion.frame(k), point.number, point.at);
        return component === null ? Math.hypot(...value) : value[component];
      };
      const curve = new Curve(motion, point.name, key, unit, point.look, sample, made.get(`${point.name}.${rate}`));
      made.set(curve.name, curve);
      return curve;
    });
    const sets = [["All bodies", curves.slice(0, origins.length)], ["All points", curves.slice(origins.length)]];
    return { key, group: POINTS, name, symbol, curves, sets };
  };
  return [...MOVING].reverse().map(quantity).reverse();
}

/** Forces and torques of joints, drivers and force elements on their body j. */
function ofElements(scene, motion) {
  const { reactions } = scene.frames;
  const ofJoint = {
    force: (joint) => (k) => Math.hypot(...reactions[k][joint].map(known)),
    force_x: (joint) => (k) => reactions[k][joint][0],
    force_y: (joint) => (k) => reactions[k][joint][1],
  };
  return [["reactions", "Reactions", "Reaction"], ["forces", "Force elements", "Element"]].flatMap(([group, title, prefix]) =>
    Object.entries(ACTING).map(([key, [name, symbol]]) => {
      const unit = key === "torque" ? "N·m" : "N";
      const joints = group === "reactions" && ofJoint[key] ? scene.joints : [];
      const first = joints.map((joint, k) => new Curve(motion, joint.name, key, unit, k, ofJoint[key](k)));
      const channels = scene.channels.filter((channel) => channel.group === group && channel.quantity === key);
      const curves = [...first, ...channels.map((channel, k) => ofChannel(motion, channel, first.length + k))];
      return { key: `${group}.${key}`, group: title, name: `${prefix} ${name}`, symbol, curves };
    }),
  );
}

/** Channels of a group, one quantity for each unit. */
function ofScene(scene, motion, group) {
  const [title, name, symbol] = OF_SCENE[group];
  const channels = scene.channels.filter((channel) => channel.group === group);
  const units = [...new Set(channels.map(({ unit }) => unit))];
  return units.map((unit) => {
    const curves = channels.filter((channel) => channel.unit === unit).map((channel, k) => ofChannel(motion, channel, k));
    return { key: `${group}.${unit}`, group: title, name: units.length > 1 ? `${name} / ${unit}` : name, symbol, curves };
  });
}

function ofChannel(motion, { name, of, quantity, unit, values }, look) {
  return new Curve(motion, of || name, of ? quantity : "", unit, look, (k) => values[k]);
}

/** The choices of a quantity: all curves together, and each one alone. */
export function choices({ curves, sets = [["All", curves]] }) {
  const subjects = new Set(curves.map(({ subject }) => subject));
  const together = sets.filter(([, members]) => members.length > 1).map(([name, members]) => ({ name, curves: members }));
  const name = (curve) => (subjects.size === curves.length ? curve.subject : curve.name);
  return [...together, ...curves.map((curve) => ({ name: name(curve), curves: [curve] }))];
}
