import { deflateSync } from "fflate";
import { expect, test } from "vitest";
import { codeOf, MOST_OF_CODE } from "../src/give/code";
import { frameOf, isFramed, linkOf, MOST_OF_LINK, textOf, wholeLink } from "../src/give/link";
import { MOST_OF_TEXT } from "../src/store/limits";

function hashOf(bytes: Uint8Array): string {
  const letters = Array.from(bytes, (byte) => String.fromCharCode(byte)).join("");
  return `#m=${btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "")}`;
}

test("the text of a link is that of which it was made", () => {
  const text = 'kempe = 1\ntitle = "Pendel — 30°, 振り子"\n'.repeat(50);
  const link = linkOf(text, "file:///studio/index.html#old");
  expect(link.startsWith("file:///studio/index.html#m=")).toBe(true);
  expect(textOf(new URL(link).hash)).toBe(text);
});

test("a page without a model in its address has none", () => {
  expect(textOf("")).toBeNull();
  expect(textOf("#top")).toBeNull();
});

test("a text at the limit is read, a longer one is refused before it is inflated", () => {
  expect(textOf(hashOf(deflateSync(new Uint8Array(MOST_OF_TEXT).fill(97))))).toHaveLength(MOST_OF_TEXT);
  expect(() => textOf(hashOf(deflateSync(new Uint8Array(MOST_OF_TEXT + 1).fill(97))))).toThrow("too long");
});

test("a bomb is refused within a second", () => {
  const bomb = deflateSync(new Uint8Array(60 * 1024 * 1024));
  expect(hashOf(bomb).length).toBeGreaterThan(MOST_OF_LINK / 2);
  const began = performance.now();
  expect(() => textOf(hashOf(bomb))).toThrow("too long");
  expect(performance.now() - began).toBeLessThan(1000);
});

test("a damaged, cut or overlong link is refused", () => {
  const whole = hashOf(deflateSync(new TextEncoder().encode("kempe = 1\n".repeat(3))));
  expect(() => textOf(whole.slice(0, -4))).toThrow();
  expect(() => textOf("#m=%%%")).toThrow();
  expect(() => textOf(`#m=${"A".repeat(MOST_OF_LINK)}`)).toThrow("too long");
});

test("a frame has the model, and leads back to the link", () => {
  const link = linkOf("title = 'four bars'\n", "https://host/page?a=1&b=2");
  const frame = frameOf(link, '"><script>');
  expect(frame).toContain('title="&quot;&gt;&lt;script&gt;"');
  const address = /src="([^"]*)"/.exec(frame)![1]!.replaceAll("&amp;", "&");
  expect(isFramed(new URL(address).hash)).toBe(true);
  expect(textOf(new URL(address).hash)).toBe("title = 'four bars'\n");
  expect(wholeLink(address)).toBe(link);
  expect(isFramed(new URL(link).hash)).toBe(false);
});

test("a code has a limit", () => {
  expect(codeOf("a".repeat(MOST_OF_CODE))!.size).toBe(177 + 8);
  expect(codeOf("a".repeat(MOST_OF_CODE + 1))).toBeNull();
});
