// Sends requests one at a time, as promises. A request replaces a waiting request of the same channel.
import type { Answer, Do, Problem, Requests } from "./protocol";

/** The part of a worker that the transport uses. */
export interface Line {
  postMessage(message: unknown): void;
  terminate(): void;
  onmessage: ((event: MessageEvent) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

/** An error that the core reports. */
export class CoreError extends Error {
  constructor(readonly problem: Problem & { problems?: Problem[] }) {
    super(problem.message);
  }
}

/** The worker was restarted, because it trapped or took too long. */
export class Restarted extends Error {
  constructor(override readonly cause: "trap" | "timeout") {
    super(cause);
  }
}

/** The time limit of runs, as a multiple of the limit of other requests. */
const LONGER: Partial<Record<Do, number>> = {
  run: 6,
  configurations: 3,
  answer: 6,
  slopes: 6,
  optimize: 6,
  improve: 6,
  synthesis: 6,
};

/** The request was replaced by a newer one before it was sent. */
export class Superseded extends Error {}

interface Waiting {
  number: number;
  request: string;
  limit: number;
  channel: string | null;
  resolve(answer: Answer<unknown>): void;
  reject(error: Error): void;
}

type Reply = { ready?: true; number?: number; reply?: string; numbers?: Float64Array; failed?: string };

export class Transport {
  private queue: Waiting[] = [];
  private running: Waiting | null = null;
  private line: Line | null = null;
  private ready = false;
  private count = 0;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** `begin` makes a worker and sends it the core; `restarted` is called after a restart. */
  constructor(
    private readonly begin: () => Line,
    private readonly restarted: (reason: "trap" | "timeout") => void,
    private readonly limit = 10_000,
  ) {
    this.start();
  }

  private start(): void {
    this.ready = false;
    const line = this.begin();
    this.line = line;
    line.onmessage = (event) => this.receive(event.data as Reply);
    line.onerror = (event) => {
      event.preventDefault?.();
      this.restart("trap");
    };
  }

  /** Send a request. With a channel, only the newest waiting request of this channel is sent. */
  send<D extends Do>(
    what: D,
    fields: Requests[D]["send"],
    channel: string | null = null,
  ): Promise<Answer<Requests[D]["reply"]>> {
    return new Promise((resolve, reject) => {
      const one: Waiting = {
        number: ++this.count,
        request: JSON.stringify({ do: what, ...fields }),
        limit: this.limit * (LONGER[what] ?? 1),
        channel,
        resolve: resolve as (answer: Answer<unknown>) => void,
        reject,
      };
      const place = channel === null ? -1 : this.queue.findIndex((other) => other.channel === channel);
      if (place >= 0) this.queue.splice(place, 1, one)[0]!.reject(new Superseded());
      else this.queue.push(one);
      this.next();
    });
  }

  /** End the worker; open requests are never answered. */
  end(): void {
    clearTimeout(this.timer);
    this.line?.terminate();
    this.running = null;
    this.queue = [];
  }

  /** The number of requests that wait or run. */
  get busy(): number {
    return this.queue.length + (this.running ? 1 : 0);
  }

  private next(): void {
    if (!this.ready || this.running || !this.queue.length) return;
    this.running = this.queue.shift()!;
    this.timer = setTimeout(() => this.restart("timeout"), this.running.limit);
    this.line?.postMessage({ number: this.running.number, request: this.running.request });
  }

  private receive(message: Reply): void {
    if (message.ready) {
      this.ready = true;
      this.next();
      return;
    }
    if (message.failed !== undefined) {
      this.restart("trap");
      return;
    }
    const one = this.running;
    if (!one || one.number !== message.number) return;
    clearTimeout(this.timer);
    this.running = null;
    settle(one, message.reply ?? "", message.numbers ?? new Float64Array());
    this.next();
  }

  private restart(reason: "trap" | "timeout"): void {
    clearTimeout(this.timer);
    this.line?.terminate();
    const lost = this.running;
    const waiting = this.queue;
    this.running = null;
    this.queue = [];
    if (!this.ready && !lost) {
      // The core did not start, and would not start in a new worker either.
      for (const one of waiting) one.reject(new Restarted(reason));
      this.restarted(reason);
      return;
    }
    this.start();
    this.restarted(reason);
    for (const one of [lost, ...waiting]) one?.reject(new Restarted(reason));
  }
}

function settle(one: Waiting, text: string, numbers: Float64Array): void {
  const reply = JSON.parse(text) as { ok?: unknown; error?: Problem };
  if (reply.error) one.reject(new CoreError(reply.error));
  else one.resolve({ ok: reply.ok, numbers });
}
