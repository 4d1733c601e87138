// The scene: the data of the page, as docs/scene.md describes them.
import type { Item } from "../draw/items";
import type { Placement, Point } from "../plane/points";
import type { Bounds } from "../plane/view";

export interface Frames {
  t: number[];
  poses: Placement[][];
  rates: Placement[][];
  accelerations: Placement[][];
  /** The force of each joint on its body j. */
  reactions: Point[][];
}

export interface Channel {
  name: string;
  group: string;
  of: string;
  quantity: string;
  unit: string;
  values: number[];
}

type Rate = "velocity" | "angular_velocity" | "acceleration" | "angular_acceleration";

export interface Scene {
  title: string;
  /** SI units; in a motion over a quantity, rates are derivatives by it. */
  units: Record<"length" | "angle" | "force" | "torque" | Rate, string>;
  gravity: Point;
  bounds: Bounds;
  length: { unit: string; metres: number };
  /** Ground first. */
  bodies: { name: string; number: number; kind: string; points: { name: string; at: Point }[]; center: Point }[];
  joints: { name: string; bodies: [number, number]; points: [Point, Point] }[];
  symbols: { element: string; mark: string; bodies: number[] }[];
  traces: { name: string; body: number; point: Point }[];
  variable: { name: string; unit: string; shown: string; divisor: number; condition: string };
  frames: Frames;
  interpolation: "cubic" | "none";
  accuracy: number | null;
  /** The reason why a state does not determine accelerations and reactions; otherwise empty. */
  undetermined: string;
  events: { name: string; t: number }[];
  playback: { rate: number };
  reaction_scale: { force: number; length: number };
  largest: { force: number; velocity: number; acceleration: number };
  /** The ends of elements: a point in the frame of a body, and the sign of the force relative to that on body j. */
  ends: {
    element: string;
    group: "joints" | "drivers" | "forces";
    body: number;
    frame: number;
    point: Point;
    sign: 1 | -1;
    remark: string;
  }[];
  channels: Channel[];
  display: Item[];
}

/** Read a scene from JSON. Numbers that are not finite are null in JSON, and NaN in the result. */
export function parsed(text: string): Scene {
  const scene = JSON.parse(text) as Scene;
  const { poses, rates, accelerations, reactions } = scene.frames;
  for (const frames of [poses, rates, accelerations, reactions])
    for (const rows of frames) for (const row of rows) fill(row);
  for (const { values } of scene.channels) fill(values);
  return scene;
}

function fill(row: readonly (number | null)[]): void {
  const values = row as (number | null)[];
  values.forEach((value, k) => {
    if (value === null) values[k] = Number.NaN;
  });
}
