// Arrays in the format of NumPy: NPY version 1.0 in a zip (numpy.lib.format).
import { unzipSync, zipSync } from "fflate";

export interface NumbersOf {
  shape: number[];
  values: Float64Array;
}

const ALIGNMENT = 64;

/** The content of a file: arrays of double precision, and texts. */
export interface Contents {
  arrays: Record<string, NumbersOf>;
  texts: Record<string, string[]>;
}

/** One array as NPY, double precision, little endian, row by row. */
export function npy({ shape, values }: NumbersOf): Uint8Array {
  const { bytes, begin } = withHead("<f8", shape, 8 * values.length);
  const data = new DataView(bytes.buffer);
  values.forEach((value, k) => data.setFloat64(begin + 8 * k, value, true));
  return bytes;
}

/** A list of texts as NPY, in UTF-32. Each text takes the room of the longest one. */
function npyOfTexts(texts: readonly string[]): Uint8Array {
  const letters = texts.map((text) => [...text].map((letter) => letter.codePointAt(0)!));
  const most = Math.max(1, ...letters.map(({ length }) => length));
  const { bytes, begin } = withHead(`<U${most}`, [texts.length], 4 * most * texts.length);
  const data = new DataView(bytes.buffer);
  letters.forEach((text, row) => {
    text.forEach((letter, k) => data.setUint32(begin + 4 * (row * most + k), letter, true));
  });
  return bytes;
}

/** The bytes of an array with its head; its values are zero. */
function withHead(type: string, shape: readonly number[], size: number): { bytes: Uint8Array; begin: number } {
  const sizes = shape.length === 1 ? `${shape[0]},` : shape.join(", ");
  const head = `{'descr': '${type}', 'fortran_order': False, 'shape': (${sizes}), }`;
  const length = Math.ceil((10 + head.length + 1) / ALIGNMENT) * ALIGNMENT;
  const bytes = new Uint8Array(length + size);
  bytes.set([0x93, ...[..."NUMPY"].map((letter) => letter.charCodeAt(0)), 1, 0]);
  const data = new DataView(bytes.buffer);
  data.setUint16(8, length - 10, true);
  bytes.set(
    [...`${head.padEnd(length - 11)}\n`].map((letter) => letter.charCodeAt(0)),
    10,
  );
  return { bytes, begin: length };
}

/** Arrays and lists of texts by name as NPZ. */
export function npz(arrays: Record<string, NumbersOf>, texts: Contents["texts"] = {}): Uint8Array {
  const files = [
    ...Object.entries(arrays).map(([name, one]) => [`${name}.npy`, npy(one)] as const),
    ...Object.entries(texts).map(([name, one]) => [`${name}.npy`, npyOfTexts(one)] as const),
  ];
  return zipSync(Object.fromEntries(files));
}

/** Larger arrays are not read, bytes. */
const MOST = 256 * 2 ** 20;

/** The arrays of double precision and the texts in an NPZ, by name; others are left out. */
export function readNpz(bytes: Uint8Array): Contents {
  const files = unzipSync(bytes, { filter: ({ name, originalSize }) => name.endsWith(".npy") && originalSize < MOST });
  const found: Contents = { arrays: {}, texts: {} };
  for (const [file, one] of Object.entries(files)) {
    const name = file.replace(/\.npy$/, "");
    const { type, shape, data } = opened(one);
    const count = shape.reduce((product, n) => product * n, 1);
    if (type === "f8" && data.byteLength === 8 * count) found.arrays[name] = { shape, values: new Float64Array(data) };
    const most = Number(/^U(\d+)$/.exec(type)?.[1] ?? 0);
    if (most && data.byteLength === 4 * most * count) found.texts[name] = textsOf(new Uint32Array(data), most);
  }
  return found;
}

/** Type, shape and data of an array in C order, little endian. The type is empty for other arrays. */
function opened(bytes: Uint8Array): { type: string; shape: number[]; data: ArrayBuffer } {
  const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const long = data.getUint8(6) > 1;
  const begin = (long ? 12 : 10) + (long ? data.getUint32(8, true) : data.getUint16(8, true));
  const head = new TextDecoder("latin1").decode(bytes.subarray(10, begin));
  const shape = /'shape': \(([\d, ]*)\)/.exec(head)?.[1]?.match(/\d+/g)?.map(Number) ?? [];
  const type = /'fortran_order': False/.test(head) ? (/'descr': '<(\w+)'/.exec(head)?.[1] ?? "") : "";
  return { type, shape, data: bytes.slice(begin).buffer };
}

/** The texts of an array. Each has a fixed number of letters, filled with zeros. */
function textsOf(letters: Uint32Array, most: number): string[] {
  return Array.from({ length: letters.length / most }, (_, row) => {
    const own = [...letters.subarray(row * most, (row + 1) * most)].filter((letter) => letter > 0 && letter < 0x110000);
    return own.map((letter) => String.fromCodePoint(letter)).join("");
  });
}
