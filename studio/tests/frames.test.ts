import { afterEach, expect, it, vi } from "vitest";
import { Frames } from "../src/modes/frames";

let waiting: ((now: number) => void)[] = [];

/** A screen that shows a frame when the test calls it. */
function screen(): (ms: number) => Promise<void> {
  let now = performance.now();
  waiting = [];
  vi.stubGlobal("requestAnimationFrame", (done: (now: number) => void) => waiting.push(done));
  return async (ms) => {
    now += ms;
    await new Promise((done) => setTimeout(done));
    for (const done of waiting.splice(0)) done(now);
    await new Promise((done) => setTimeout(done));
  };
}

afterEach(() => vi.unstubAllGlobals());

it("calls once for each frame with the time between frames, until it is stopped", async () => {
  const frame = screen();
  const frames = new Frames();
  const times: number[] = [];
  void frames.play((ms) => times.push(ms) > 0);
  await frame(16);
  await frame(20);
  await frame(-5);
  expect(times.slice(1)).toEqual([20, 0]);
  frames.stop();
  await frame(16);
  expect(times.length).toBe(3);
  expect(frames.playing.value).toBe(false);
});

it("goes on once after it is stopped and started within one frame", async () => {
  const frame = screen();
  const frames = new Frames();
  let [old, recent] = [0, 0];
  void frames.play(() => ++old > 0);
  await frame(16);
  frames.stop();
  void frames.play(() => ++recent > 0);
  await frame(16);
  await frame(16);
  expect([old, recent]).toEqual([1, 2]);
  expect(frames.playing.value).toBe(true);
});

it("ends when a frame ends it or fails", async () => {
  const frame = screen();
  const frames = new Frames();
  void frames.play(() => false);
  await frame(16);
  expect(frames.playing.value).toBe(false);
  const failed = frames.play(() => Promise.reject(new Error("broken"))).catch((error) => error.message);
  await frame(16);
  expect(await failed).toBe("broken");
  expect(frames.playing.value).toBe(false);
});
