import { expect, test, vi } from "vitest";
import { CoreError, type Line, Restarted, Superseded, Transport } from "../src/core/transport";

/** A worker whose answers the test sends. */
class Scripted implements Line {
  onmessage: ((event: MessageEvent) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;
  sent: { number: number; request: string }[] = [];
  ended = false;

  postMessage(message: unknown): void {
    this.sent.push(message as { number: number; request: string });
  }

  terminate(): void {
    this.ended = true;
  }

  say(data: object): void {
    this.onmessage?.({ data } as MessageEvent);
  }

  answer(reply: object): void {
    this.say({ number: this.sent.at(-1)!.number, reply: JSON.stringify(reply), numbers: new Float64Array([1]) });
  }
}

function made(limit = 10_000) {
  const lines: Scripted[] = [];
  const restarts: string[] = [];
  const begin = () => {
    lines.push(new Scripted());
    return lines.at(-1)!;
  };
  const transport = new Transport(begin, (reason) => restarts.push(reason), limit);
  lines[0]!.say({ ready: true });
  return { lines, restarts, transport };
}

test("a reply settles its request, with the numbers", async () => {
  const { lines, transport } = made();
  const promise = transport.send("load", { text: "x" });
  expect(JSON.parse(lines[0]!.sent[0]!.request)).toEqual({ do: "load", text: "x" });
  lines[0]!.answer({ ok: { problems: [] } });
  const { ok, numbers } = await promise;
  expect(ok).toEqual({ problems: [] });
  expect([...numbers]).toEqual([1]);
});

test("an error of the core rejects with its problem", async () => {
  const { lines, transport } = made();
  const promise = transport.send("load", { text: "x" });
  lines[0]!.answer({ error: { message: "no joint", hint: "add one" } });
  await expect(promise).rejects.toThrow(CoreError);
  await expect(promise).rejects.toMatchObject({ problem: { hint: "add one" } });
});

test("of the requests of a channel that wait, only the newest is sent", async () => {
  const { lines, transport } = made();
  const at = (x: number) =>
    transport.send("drag", { body: "b", point: [0, 0], to: [x, 0] }, "drag").then(
      () => "done",
      (error: unknown) => (error instanceof Superseded ? "dropped" : "failed"),
    );
  const all = [at(1), at(2), at(3)];
  lines[0]!.answer({ ok: {} });
  await all[0];
  lines[0]!.answer({ ok: {} });
  expect(await Promise.all(all)).toEqual(["done", "dropped", "done"]);
  expect(lines[0]!.sent.map(({ request }) => JSON.parse(request).to[0])).toEqual([1, 3]);
});

test("requests without a channel all arrive, in order", async () => {
  const { lines, transport } = made();
  const all = [transport.send("pose", {}), transport.send("quantities", {})];
  lines[0]!.answer({ ok: 1 });
  await all[0];
  lines[0]!.answer({ ok: 2 });
  await all[1];
  expect(lines[0]!.sent.map(({ request }) => JSON.parse(request).do)).toEqual(["pose", "quantities"]);
});

test("a trap makes a new worker, and later requests are answered", async () => {
  const { lines, restarts, transport } = made();
  const lost = transport.send("run", {});
  lines[0]!.say({ failed: "unreachable", number: 1 });
  await expect(lost).rejects.toThrow(Restarted);
  expect([lines.length, lines[0]!.ended, restarts]).toEqual([2, true, ["trap"]]);
  const next = transport.send("pose", {});
  expect(lines[1]!.sent).toEqual([]);
  lines[1]!.say({ ready: true });
  lines[1]!.answer({ ok: 5 });
  expect((await next).ok).toBe(5);
});

test.each([
  ["pose", 10_000],
  ["run", 60_000],
] as const)("%s over the limit of %d ms ends its worker", async (what, limit) => {
  vi.useFakeTimers();
  const { lines, restarts, transport } = made(10_000);
  const lost = transport.send(what, {}).catch((error: unknown) => error);
  vi.advanceTimersByTime(limit - 1);
  expect(lines.length).toBe(1);
  vi.advanceTimersByTime(2);
  expect(await lost).toBeInstanceOf(Restarted);
  expect([lines.length, restarts]).toEqual([2, ["timeout"]]);
  vi.useRealTimers();
});

test("a core that never starts is not started again and again", async () => {
  const lines: Scripted[] = [];
  const transport = new Transport(
    () => {
      lines.push(new Scripted());
      return lines.at(-1)!;
    },
    () => {},
  );
  const promise = transport.send("catalogue", {});
  lines[0]!.say({ failed: "no memory" });
  await expect(promise).rejects.toThrow(Restarted);
  expect(lines.length).toBe(1);
});
