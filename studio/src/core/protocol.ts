// Requests to the core and its replies; bindings/web/README.md describes them.

import type { Item } from "../draw/items";
import type { Point } from "../plane/points";

export interface Problem {
  message: string;
  hint?: string | null;
  path?: string | null;
  line?: number | null;
  column?: number | null;
  length?: number | null;
}

export type Value = string | number | boolean | null | Value[] | { [key: string]: Value };
export type Tree = { [key: string]: Value };
export type Path = string[];

/** A change of the text: a value, a new name for a key, or its removal. */
export type Change = { path: Path; value: Value } | { path: Path; rename: string } | { path: Path; remove: true };

export interface Body {
  name: string;
  kind: string;
  ground: boolean;
  points: Record<string, Point>;
  center: Point;
  mass: number | null;
  inertia: number | null;
}

export interface Named {
  name: string;
  type: string;
}

export interface Parameter {
  name: string;
  value: number;
  unit: string | null;
}

export interface Mechanism {
  title: string;
  gravity: Point;
  bodies: Body[];
  joints: Named[];
  drivers: Named[];
  forces: Named[];
  parameters: Parameter[];
  analyses: Named[];
  degrees_of_freedom: number | null;
  warnings: string[];
  coordinates: string[];
}

export type Triple = [number, number, number];

export interface Pose {
  t: number;
  q: number[];
  v: number[];
  z: number[];
  poses: Triple[];
  rates: Triple[];
  residual: number;
}

export interface Loaded {
  problems: Problem[];
  case: Tree | null;
  mechanism: Mechanism | null;
  pose: Pose | null;
  unassembled: Problem | null;
}

/** Energies in J; the balance is relative to the largest energy of the motion. */
export interface Energy {
  kinetic: number;
  potential: number;
  dissipated: number;
  work: number;
  balance: number;
}

export interface Live extends Pose {
  energy: Energy;
  drift: number;
  events: { name: string; t: number }[];
  ended: string | null;
}

export interface Ran {
  count: number;
  t_end: number;
  message?: string;
  status: string;
  statistics: Record<string, Value>;
  events: { name: string; t: number }[];
  error: Problem | null;
  /** The quantity that replaces the time; null in a run over time. */
  over: (Quantity & { condition: string }) | null;
  /** The joints and drivers whose reactions are not unique. */
  not_unique: string[];
  shared: string[];
  remarks: string[];
}

/** A named value of a result; the unit is empty without one, and the value null where the name is enough. */
export interface Fact {
  name: string;
  value: string | number | null;
  unit: string;
}

/** A result that is not a motion. */
export interface Found {
  status: "found";
  facts: Fact[];
  /** Positions that can be drawn, each with its name. */
  positions: (Fact & { pose: Pose })[];
  /** Closed lines around areas, m. */
  outlines: Point[][];
  findings: Value;
  remarks: string[];
  error: null;
}

/** The obstacle of an analysis; its `path` leads to the element. */
export interface Readiness {
  analysis: string;
  problem: Problem | null;
}

export interface Quantity {
  name: string;
  unit: string;
}

export interface Mobility {
  gruebler: number;
  degrees_of_freedom: number;
  rank: number;
  redundant: Value[];
  singular: Value[];
  /** The links that turn fully; null at a change point, where this depends on the branch. */
  four_bars: { pins: string[]; kind: string; turning: string[] | null }[];
}

/** A force on a body at a place, with its moment about this place. */
export interface Load {
  name: string;
  kind: "joint" | "driver" | "force" | "gravity";
  body: number;
  place: Point;
  force: Point;
  moment: number;
}

/** A run at one output. Bodies have their numbers, ground is 0. Null is what is not unique. */
export interface Instant {
  t: number;
  bodies: {
    pose: Triple;
    rate: Triple;
    acceleration: Triple | null;
    mass: number;
    inertia: number;
    turns: boolean;
    center: Point;
  }[];
  joints: { name: string; slides: boolean; bodies: [number, number]; points: [Point, Point]; axis: number }[];
  loads: Load[] | null;
}

/** A four-bar that takes the poses of a task. */
export interface Candidate {
  /** At the first pose, m. */
  points: Record<"O" | "A" | "B" | "D" | "P", Point>;
  /** The angle of the moving frame at the first pose, rad. */
  frame: number;
  /** Crank, coupler, rocker and ground, m. */
  lengths: [number, number, number, number];
  type: string;
  grashof: boolean;
  turns: boolean;
  transmission_angle: number;
  error: number;
  defects: string[];
  crank_angles: number[];
}

/** A question of a case, with the values of its variant. */
export interface Question {
  name: string;
  text: string;
  /** The unit of an answer without one. */
  unit: string;
  hints: string[];
  points: number;
}

/** The section [exercise] of a case. */
export interface Exercise {
  seed: number;
  /** Whether it has random parameters. */
  random: boolean;
  text: string;
  parameters: { name: string; value: number; shown: string }[];
  questions: Question[];
}

/** A search for the values of parameters that are best within limits, in SI units. */
export interface Search {
  runs: number;
  failed: number;
  /** Why a run failed. */
  reason: string | null;
  ending: "best" | "corner" | "enough" | null;
  /** The objective, its unit, and its value before and now. */
  label: string;
  unit: string;
  before: number | null;
  now: number;
  values: Record<string, number>;
  /** The room of each limit, as a part of the size of what it compares. */
  room: number[];
}

/** The answer to the section [synthesis]. */
export interface Solved {
  poses: Triple[];
  points: Point[];
  /** Of the search for a path: starts that were tried, and those after which it ends. */
  tried?: number;
  most?: number;
  refused: { message: string; hint?: string | null } | null;
  complete: boolean;
  excluded: { kind: string; count: number }[];
  candidates: Candidate[];
}

/** The programme and the sizes of a cam, in SI units; the arguments of `kp.design.cam`. */
export interface CamGiven {
  follower: "roller" | "knife" | "flat";
  closure: "force" | "groove" | "conjugate";
  direction: "ccw" | "cw";
  base_radius: number;
  roller_radius: number;
  offset: number;
  arm: number | null;
  pivot: Point | null;
  face: number;
  speed: number;
  mass: number;
  spring: Point;
  gravity: number;
  programme: { way: "rise" | "dwell" | "return"; angle: number; lift: number | null; law: string }[];
}

/** The curves of a cam, as pairs of numbers, its limits, and what is doubtful. */
export interface CamFound {
  angles: number[];
  curves: { profile: number[]; pitch?: number[]; outer?: number[]; conjugate?: number[] };
  diagram: { angle: number[]; s: number[]; v: number[]; a: number[] };
  /** The follower at the angle 0. */
  start: { pitch: Point; normal: Point; profile: Point };
  pressure_angle: { largest: number; at: number; recommended: number };
  /** Null where it is infinite. */
  radius_of_curvature: { least: number | null; at: number };
  undercut: Point[];
  remedies: { base: number | null; roller: Point | null } | null;
  /** The least base radius for the recommended pressure angle without undercut. */
  least_base: number | null;
  /** Null if the follower never leaves the cam. */
  lift_off_speed: number | null;
  remarks: string[];
}

/** The static part of a scene; docs/scene.md describes all of it. */
export interface Scene {
  bounds: [number, number, number, number];
  length: { unit: string; metres: number };
  gravity: Point;
}

/** The fields and the reply of each request. */
export interface Requests {
  catalogue: { send: object; reply: unknown };
  read: { send: { text: string; name: string }; reply: { text: string; lost: number } };
  load: { send: { text: string }; reply: Loaded };
  edit: { send: { changes: Change[] }; reply: { text: string } };
  pose: { send: { q?: number[] }; reply: Pose };
  assemble: { send: { set?: Record<string, Value>; guess?: Record<string, Value> }; reply: Pose };
  drag: {
    send: { body: string; point: Point; to: Point; locked?: string[] };
    reply: { pose: Pose; stopped: string | null };
  };
  configurations: { send: { limit?: number }; reply: { complete: boolean; poses: Pose[] } };
  mobility: { send: object; reply: Mobility };
  readiness: { send: object; reply: Readiness[] };
  quantities: { send: { of_run?: true }; reply: Quantity[] };
  quantity: { send: { name: string }; reply: { value: number; unit: string } };
  scene: { send: object; reply: { scene: Scene } };
  display: {
    send: { width: number; height: number; names?: boolean; numbers?: boolean };
    reply: { items: Item[] };
  };
  live: { send: { method?: Value; stabilization?: Value }; reply: Pose };
  advance: { send: { by: number; most_ms?: number }; reply: Live };
  pull: {
    send: { body: string | null; point?: Point; to?: Point; stiffness?: number; damping?: number };
    reply: object;
  };
  parameters: { send: { values: Record<string, number> }; reply: Pose };
  run: {
    send: { analysis?: string; t_end?: number; output_step?: number; over?: string; range?: [string, string] };
    reply: Ran | Found;
  };
  exercise: { send: { seed?: number }; reply: Exercise };
  variant: { send: { seed: number }; reply: { changes: Change[] } };
  answer: { send: { question: string; given: string }; reply: { right: boolean; value: number } };
  slopes: {
    send: { measure: string; analysis?: string };
    reply: { value: number; unit: string; slopes: { name: string; slope: number | null; remark: string | null }[] };
  };
  optimize: { send: object; reply: Search };
  improve: { send: object; reply: Search };
  synthesis: { send: { starts?: number }; reply: Solved };
  candidate: { send: { choice: number }; reply: { changes: Change[] } };
  cam: { send: CamGiven; reply: CamFound };
  cam_case: { send: CamGiven; reply: { text: string } };
  cam_drawing: { send: CamGiven; reply: { text: string } };
  instant: { send: { at: number }; reply: Instant };
  frames: { send: object; reply: object };
  values: { send: { names: string[] }; reply: { units: string[] } };
  save: { send: { format: "toml" | "json" }; reply: { text: string } };
}

export type Do = keyof Requests;

/** A reply with its numbers. */
export interface Answer<T> {
  ok: T;
  numbers: Float64Array;
}
