// How large the quantities of a mechanism are; far below that, numbers are rounding errors.
import { known } from "./motion.js";
import { extent } from "./view.js";

/** The natural scale of each unit, as a table. */
export function naturalScales(scene) {
  const { poses, rates, accelerations, reactions } = scene.frames;
  const size = extent(scene.bounds);
  const length = Math.max(size, ...scene.bounds.map(Math.abs));
  const velocity = largestMotion(rates, size);
  const acceleration = largestMotion(accelerations, size);
  const channels = (unit) => largest(scene.channels.filter((one) => one.unit === unit && one.group !== "accuracy").map(({ values }) => values));
  const force = Math.max(largest(reactions.flat()), channels("N"), channels("N·m") / size);
  return {
    m: length,
    rad: poses.length ? 1 : 0,
    "m/s": velocity,
    "rad/s": velocity / size,
    "m/s²": acceleration,
    "rad/s²": acceleration / size,
    N: force,
    "N·m": force * size,
    J: channels("J"),
  };
}

/** The largest of the translations and of the rotations times the size. */
function largestMotion(frames, size) {
  return largest(frames.flat().map(([x, y, turn]) => [x, y, turn * size]));
}

function largest(rows) {
  let most = 0;
  for (const row of rows) {
    for (const value of row) most = Math.max(most, Math.abs(known(value)) || 0);
  }
  return most;
}
