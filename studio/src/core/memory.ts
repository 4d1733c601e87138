// The calling convention of the compiled core: texts and numbers in its memory.

interface Exports {
  memory: WebAssembly.Memory;
  request(length: number): number;
  call(): number;
  reply(): number;
  reply_length(): number;
  numbers(): number;
  numbers_length(): number;
}

/** One instance of the core. */
export class Core {
  private readonly exports: Exports;

  constructor(instance: WebAssembly.Instance) {
    this.exports = instance.exports as unknown as Exports;
  }

  /** Send a request. Returns the reply and a copy of its numbers. */
  call(request: string): { reply: string; numbers: Float64Array } {
    const bytes = new TextEncoder().encode(request);
    const core = this.exports;
    const room = core.request(bytes.length);
    new Uint8Array(core.memory.buffer, room, bytes.length).set(bytes);
    core.call();
    const reply = new TextDecoder().decode(new Uint8Array(core.memory.buffer, core.reply(), core.reply_length()));
    const numbers = new Float64Array(core.memory.buffer, core.numbers(), core.numbers_length()).slice();
    return { reply, numbers };
  }

  /** The memory of the core, bytes. */
  get size(): number {
    return this.exports.memory.buffer.byteLength;
  }
}

/** Start a core. It imports only a clock, in ms. */
export async function instantiate(bytes: BufferSource): Promise<Core> {
  const module = await WebAssembly.compile(bytes);
  const imports: Record<string, Record<string, () => number>> = {};
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    imports[space] = { ...imports[space], [name]: () => performance.now() };
  }
  return new Core(await WebAssembly.instantiate(module, imports));
}
