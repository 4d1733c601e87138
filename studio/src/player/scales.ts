// The size of the quantities of a mechanism. Numbers far below it are rounding errors.
import { extent } from "../plane/view";
import type { Scene } from "./scene";

/** The natural scale of each unit. */
export function naturalScales(scene: Scene): Record<string, number> {
  const { poses, rates, accelerations, reactions } = scene.frames;
  const size = extent(scene.bounds);
  const length = Math.max(size, ...scene.bounds.map(Math.abs));
  const velocity = largestMotion(rates, size);
  const acceleration = largestMotion(accelerations, size);
  const kept = scene.channels.filter(({ group }) => group !== "accuracy");
  const channels = (unit: string) => largest(kept.filter((one) => one.unit === unit).map(({ values }) => values));
  const force = Math.max(largest(reactions.flat()), channels(scene.units.force), channels(scene.units.torque) / size);
  const { units } = scene;
  return {
    [units.length]: length,
    [units.angle]: poses.length ? 1 : 0,
    [units.velocity]: velocity,
    [units.angular_velocity]: velocity / size,
    [units.acceleration]: acceleration,
    [units.angular_acceleration]: acceleration / size,
    [units.force]: force,
    [units.torque]: force * size,
    J: channels("J"),
  };
}

/** The largest of the translations and of the rotations times the size. */
function largestMotion(frames: Scene["frames"]["rates"], size: number): number {
  return largest(frames.flat().map(([x, y, turn]) => [x, y, turn * size]));
}

function largest(rows: readonly (readonly number[])[]): number {
  let most = 0;
  for (const row of rows) for (const value of row) most = Math.max(most, Math.abs(value) || 0);
  return most;
}
