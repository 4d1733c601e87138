// Packs a module of WebAssembly for compression: what belongs together lies together. Operations, local variables that
// are read, those that are set, constants, addresses and calls are streams of their own, so that xz finds more in them.
// src/core/unpack.ts puts the module together again. Numbers are written as short as possible, and hints of alignment,
// which change nothing, are left out.

/** Streams by name; the first contains everything but the bodies of functions. */
const STREAMS = [
  "rest",
  "operations",
  "locals",
  "sets",
  "constants",
  "longs",
  "reals",
  "addresses",
  "far",
  "calls",
  "labels",
  "types",
  "others",
];
const [, OPERATIONS, LOCALS, SETS, CONSTANTS, LONGS, REALS, ADDRESSES, FAR, CALLS, LABELS, TYPES, OTHERS] =
  STREAMS.keys();

/** What follows an operation. Other codes are the number of the stream that has a number. */
const MANY = -1; // a count, so many numbers and one more
const LIST = -2; // a count and so many numbers
const EIGHT = -3; // eight bytes of a real number
const FOUR = -4;
const HINT = -5; // a hint that is left out
const PLACE = -6; // an address of one byte; after the largest byte, it is a number among the far ones
const LARGEST = 255;

const numbered = (first, last, ...parts) => Array.from({ length: last - first + 1 }, (_, k) => [first + k, parts]);
/** The operations with more than their code: WebAssembly 2.0 without vectors. */
const FOLLOWING = Object.fromEntries([
  ...numbered(0x02, 0x04, TYPES),
  ...numbered(0x0c, 0x0d, LABELS),
  [0x0e, [MANY]],
  [0x10, [CALLS]],
  [0x11, [TYPES, OTHERS]],
  [0x1c, [LIST]],
  [0x20, [LOCALS]],
  ...numbered(0x21, 0x22, SETS),
  ...numbered(0x23, 0x26, OTHERS),
  ...numbered(0x28, 0x3e, HINT, PLACE),
  ...numbered(0x3f, 0x40, OTHERS),
  [0x41, [CONSTANTS]],
  [0x42, [LONGS]],
  [0x43, [FOUR]],
  [0x44, [EIGHT]],
  ...numbered(0x45, 0xc4),
  [0xd0, [OTHERS]],
  [0xd2, [OTHERS]],
]);
/** Those after the prefix 0xfc. */
const PREFIXED = Object.fromEntries([
  ...numbered(0x00, 0x07),
  [0x08, [OTHERS, OTHERS]],
  [0x09, [OTHERS]],
  [0x0a, [OTHERS, OTHERS]],
  [0x0b, [OTHERS]],
]);
const PREFIX = 0xfc;
const PLAIN = [0x00, 0x01, 0x05, 0x0b, 0x0f, 0x1a, 0x1b, 0xd1];
const CODE = 10;

/** Reads a module byte by byte. */
class Reader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  byte() {
    return this.bytes[this.at++];
  }

  taken(length) {
    this.at += length;
    return this.bytes.subarray(this.at - length, this.at);
  }

  /** A number of seven bits to a byte, without the bytes that only lengthen it. */
  number(signed) {
    const bits = [];
    let byte = 0;
    do {
      byte = this.byte();
      bits.push(byte & 0x7f);
    } while (byte & 0x80);
    while (bits.length > 1 && isLonger(bits, signed)) bits.pop();
    return bits.map((one, k) => (k < bits.length - 1 ? one | 0x80 : one));
  }

  count() {
    return this.number(false).reduce((sum, one, k) => sum + (one & 0x7f) * 2 ** (7 * k), 0);
  }
}

/** Whether the last bits repeat what those before say: zeros, or the sign. */
function isLonger(bits, signed) {
  const [before, last] = bits.slice(-2);
  const isNegative = signed && (before & 0x40) !== 0;
  return last === (isNegative ? 0x7f : 0);
}

/** The packed module: lengths of the streams, then what follows each operation, then the streams. */
export function pack(module) {
  const streams = STREAMS.map(() => []);
  const reader = new Reader(module);
  streams[0].push(...reader.taken(8));
  while (reader.at < module.length) {
    const section = reader.byte();
    const length = reader.count();
    const end = reader.at + length;
    streams[0].push(section);
    if (section === CODE) packCode(reader, streams);
    else {
      streams[0].push(...shortNumber(length));
      for (const one of reader.taken(length)) streams[0].push(one);
    }
    if (reader.at !== end) throw new Error("a section of the module has another length than its content");
  }
  return joined(streams);
}

function packCode(reader, streams) {
  const count = reader.count();
  streams[0].push(...shortNumber(count));
  for (let k = 0; k < count; k += 1) {
    const length = reader.count();
    const end = reader.at + length;
    const groups = reader.count();
    streams[TYPES].push(...shortNumber(groups));
    for (let group = 0; group < groups; group += 1) {
      streams[OTHERS].push(...reader.number(false));
      streams[TYPES].push(reader.byte());
    }
    while (reader.at < end) packOperation(reader, streams);
  }
}

function packOperation(reader, streams) {
  const code = reader.byte();
  streams[OPERATIONS].push(code);
  if (PLAIN.includes(code)) return;
  let following = FOLLOWING[code];
  if (code === PREFIX) {
    const second = reader.count();
    streams[OPERATIONS].push(second);
    following = PREFIXED[second];
  }
  if (!following) throw new Error(`the module has an operation ${code.toString(16)} that is not known`);
  for (const part of following) packPart(part, reader, streams);
}

function packPart(part, reader, streams) {
  if (part === HINT) reader.number(false);
  else if (part === PLACE) {
    const address = reader.count();
    streams[ADDRESSES].push(Math.min(address, LARGEST));
    if (address >= LARGEST) streams[FAR].push(...shortNumber(address));
  } else if (part === EIGHT || part === FOUR) streams[REALS].push(...reader.taken(part === EIGHT ? 8 : 4));
  else if (part === MANY || part === LIST) {
    const count = reader.count();
    streams[LABELS].push(...shortNumber(count));
    for (let k = 0; k < count + (part === MANY ? 1 : 0); k += 1) streams[LABELS].push(...reader.number(false));
  } else if ([CONSTANTS, LONGS, TYPES].includes(part)) streams[part].push(...reader.number(true));
  else streams[part].push(...reader.number(false));
}

function shortNumber(value) {
  const bytes = [];
  for (; value >= 0x80; value = Math.floor(value / 0x80)) bytes.push((value % 0x80) | 0x80);
  return [...bytes, value];
}

function joined(streams) {
  const places = { OPERATIONS, REALS, ADDRESSES, FAR, LABELS, TYPES, OTHERS };
  const codes = { MANY, LIST, EIGHT, FOUR, HINT, PLACE, LARGEST };
  const lengths = streams.map(({ length }) => length);
  const rules = JSON.stringify({ FOLLOWING, PREFIXED, lengths, places, codes, sections: { CODE, PREFIX } });
  const head = new TextEncoder().encode(rules);
  const size = new Uint8Array(4);
  new DataView(size.buffer).setUint32(0, head.length, true);
  return Buffer.concat([size, head, ...streams.map((one) => Uint8Array.from(one))]);
}
