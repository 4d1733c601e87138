// Arrays in the format of NumPy: NPY version 1.0 in a zip (numpy.lib.format).
import { unzipSync, zipSync } from "fflate";

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

/** Arrays are not read beyond this size, bytes. */
const MOST = 256 * 2 ** 20;

/** The arrays of double precision in an NPZ, by name; others are left out. */
export function readNpz(bytes: Uint8Array): Record<string, NumbersOf> {
  const files = unzipSync(bytes, { filter: ({ name, originalSize }) => name.endsWith(".npy") && originalSize < MOST });
  const found = Object.entries(files).map(([name, one]) => [name.replace(/\.npy$/, ""), readNpy(one)] as const);
  return Object.fromEntries(found.filter((one): one is [string, NumbersOf] => one[1] !== null));
}

function readNpy(bytes: Uint8Array): NumbersOf | null {
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const long = data.getUint8(6) > 1;
  const begin = (long ? 12 : 10) + (long ? data.getUint32(8, true) : data.getUint16(8, true));
  const head = new TextDecoder("latin1").decode(bytes.subarray(10, begin));
  const shape = /'shape': \(([\d, ]*)\)/.exec(head)?.[1]?.match(/\d+/g)?.map(Number) ?? [];
  if (!/'descr': '<f8'/.test(head) || !/'fortran_order': False/.test(head)) return null;
  const values = new Float64Array(bytes.slice(begin).buffer);
  return values.length === shape.reduce((product, n) => product * n, 1) ? { shape, values } : null;
}
