// Arrays in the format of NumPy: NPY version 1.0 in a zip (numpy.lib.format).
import { zipSync } from "fflate";

export interface NumbersOf {
  shape: number[];
  values: Float64Array;
}

const ALIGNMENT = 64;

/** One array as NPY, double precision, little endian, row by row. */
export function npy({ shape, values }: NumbersOf): Uint8Array {
  const sizes = shape.length === 1 ? `${shape[0]},` : shape.join(", ");
  const head = `{'descr': '<f8', 'fortran_order': False, 'shape': (${sizes}), }`;
  const length = Math.ceil((10 + head.length + 1) / ALIGNMENT) * ALIGNMENT;
  const bytes = new Uint8Array(length + 8 * values.length);
  bytes.set([0x93, ...[..."NUMPY"].map((letter) => letter.charCodeAt(0)), 1, 0]);
  const data = new DataView(bytes.buffer);
  data.setUint16(8, length - 10, true);
  bytes.set(
    [...`${head.padEnd(length - 11)}\n`].map((letter) => letter.charCodeAt(0)),
    10,
  );
  values.forEach((value, k) => data.setFloat64(length + 8 * k, value, true));
  return bytes;
}

/** Arrays by name as NPZ. */
export function npz(arrays: Record<string, NumbersOf>): Uint8Array {
  return zipSync(Object.fromEntries(Object.entries(arrays).map(([name, one]) => [`${name}.npy`, npy(one)])));
}
