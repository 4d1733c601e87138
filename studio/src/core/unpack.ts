// Puts a module of WebAssembly together from the streams into which build/pack.mjs has taken it apart.

/** What follows an operation: the number of a stream that has a number, or one of the codes of build/pack.mjs. */
type Following = Record<string, number[]>;

interface Head {
  FOLLOWING: Following;
  PREFIXED: Following;
  /** Bytes of each stream. */
  lengths: number[];
  /** Places in the list of streams. */
  places: Record<"OPERATIONS" | "REALS" | "ADDRESSES" | "FAR" | "LABELS" | "TYPES" | "OTHERS", number>;
  codes: Record<"MANY" | "LIST" | "EIGHT" | "FOUR" | "HINT" | "PLACE" | "LARGEST", number>;
  sections: { CODE: number; PREFIX: number };
}

/** Operations that begin a block, and the one that ends it. */
const [FIRST_BLOCK, LAST_BLOCK, END] = [0x02, 0x04, 0x0b];
/** The largest number of bytes that a count needs. */
const COUNT = 5;

/** Bytes with a place, where they are read or written. */
class Tape {
  at = 0;

  constructor(readonly bytes: Uint8Array<ArrayBuffer>) {}

  taken(length: number): Uint8Array<ArrayBuffer> {
    this.at += length;
    return this.bytes.subarray(this.at - length, this.at);
  }

  append(more: Uint8Array): void {
    this.bytes.set(more, this.at);
    this.at += more.length;
  }

  /** Read a number, seven bits to a byte. */
  number(): number {
    let [value, scale, byte] = [0, 1, 0];
    do {
      byte = this.bytes[this.at++]!;
      value += (byte & 0x7f) * scale;
      scale *= 0x80;
    } while (byte & 0x80);
    return value;
  }

  /** Write a number. */
  write(value: number): void {
    let rest = value;
    for (; rest >= 0x80; rest = Math.floor(rest / 0x80)) this.bytes[this.at++] = (rest % 0x80) | 0x80;
    this.bytes[this.at++] = rest;
  }

  /** Read a number here and write it there. */
  copy(output: Tape): void {
    let byte = 0;
    do {
      byte = this.bytes[this.at++]!;
      output.bytes[output.at++] = byte;
    } while (byte & 0x80);
  }

  /** Write something with the number of its bytes before it. */
  counted(write: () => void): void {
    const begin = this.at;
    this.at += COUNT;
    write();
    const end = this.at;
    this.at = begin;
    this.write(end - begin - COUNT);
    this.bytes.copyWithin(this.at, begin + COUNT, end);
    this.at += end - begin - COUNT;
  }
}

/** The module of a packed one. */
export function unpacked(packed: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer> {
  const size = new DataView(packed.buffer, packed.byteOffset).getUint32(0, true);
  const head = JSON.parse(new TextDecoder().decode(packed.subarray(4, 4 + size))) as Head;
  const all = new Tape(packed);
  all.at = 4 + size;
  const streams = head.lengths.map((length) => new Tape(all.taken(length)));
  const rest = streams[0]!;
  // a hint and the length of a body are all that is added to an operation
  const module = new Tape(new Uint8Array(2 * packed.length + COUNT));
  module.append(rest.taken(8));
  while (rest.at < rest.bytes.length) {
    const section = rest.number();
    module.write(section);
    if (section === head.sections.CODE) module.counted(() => writeBodies(head, streams, module));
    else {
      const length = rest.number();
      module.write(length);
      module.append(rest.taken(length));
    }
  }
  return module.bytes.subarray(0, module.at);
}

/** The bodies of all functions. */
function writeBodies(head: Head, streams: Tape[], module: Tape): void {
  const [types, others] = [streams[head.places.TYPES]!, streams[head.places.OTHERS]!];
  const count = streams[0]!.number();
  module.write(count);
  const operations = writerOf(head, streams, module);
  const body = () => {
    const groups = types.number();
    module.write(groups);
    for (let group = 0; group < groups; group += 1) {
      others.copy(module);
      types.copy(module);
    }
    operations();
  };
  for (let k = 0; k < count; k += 1) module.counted(body);
}

/** A function that writes the operations of one body. */
function writerOf({ FOLLOWING, PREFIXED, places, codes, sections }: Head, streams: Tape[], module: Tape): () => void {
  const of = (place: keyof Head["places"]) => streams[places[place]]!;
  const [operations, reals, labels] = [of("OPERATIONS"), of("REALS"), of("LABELS")];
  const [addresses, far] = [of("ADDRESSES"), of("FAR")];
  const table = (rules: Following) => Array.from({ length: 256 }, (_, code) => rules[code] ?? []);
  const [plain, prefixed] = [table(FOLLOWING), table(PREFIXED)];
  const follow = (part: number) => {
    if (part >= 0) streams[part]!.copy(module);
    else if (part === codes.PLACE) {
      const address = addresses.bytes[addresses.at++]!;
      if (address < codes.LARGEST) module.write(address);
      else far.copy(module);
    } else if (part === codes.HINT) module.bytes[module.at++] = 0;
    else if (part === codes.EIGHT) module.append(reals.taken(8));
    else if (part === codes.FOUR) module.append(reals.taken(4));
    else {
      const count = labels.number();
      module.write(count);
      for (let k = part === codes.MANY ? -1 : 0; k < count; k += 1) labels.copy(module);
    }
  };
  const { bytes } = operations;
  return () => {
    let depth = 1;
    while (depth > 0) {
      const code = bytes[operations.at++]!;
      module.bytes[module.at++] = code;
      if (code >= FIRST_BLOCK && code <= LAST_BLOCK) depth += 1;
      else if (code === END) depth -= 1;
      let following = plain[code]!;
      if (code === sections.PREFIX) {
        const second = bytes[operations.at++]!;
        module.bytes[module.at++] = second;
        following = prefixed[second]!;
      }
      for (let k = 0; k < following.length; k += 1) follow(following[k]!);
    }
  };
}
