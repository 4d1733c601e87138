import { expect, test } from "vitest";
import type { Line } from "../src/core/transport";
import { open } from "../src/store/document";
import { connect } from "../src/store/session";
import { texts } from "../src/texts";

/** A core that starts and answers nothing. */
function silent(): Line {
  const line: Line = { postMessage() {}, terminate() {}, onmessage: null, onerror: null };
  setTimeout(() => line.onmessage?.({ data: { ready: true } } as MessageEvent));
  return line;
}

test("a text that the core did not read gives the reason", async () => {
  connect(silent, 20);
  expect(await open("kempe = 1\n")).toBe(texts.core.tooLong);
  expect(await open("#".repeat(3e6))).toBe(texts.core.tooLarge);
});
