// Paths of SVG in other coordinates.

/** The number of arguments of each command. */
const COUNTS: Record<string, number> = { m: 2, l: 2, h: 1, v: 1, c: 6, s: 4, q: 4, t: 2, a: 7, z: 0 };
const TOKEN = /([a-z])|([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)/gi;
const DIGITS = 6;

/** A path scaled and with y upwards: (x, y) goes to (scale x + dx, dy - scale y). Null for other texts. */
export function mappedPath(d: string, scale: number, [dx, dy]: [number, number]): string | null {
  const parts: string[] = [];
  for (const [letter, numbers] of commands(d)) {
    const kind = letter.toLowerCase();
    const count = COUNTS[kind];
    if (count === undefined || (count ? numbers.length % count : numbers.length)) return null;
    const first = !parts.length;
    if (first && kind !== "m") return null;
    // the first point is absolute; the pairs after it are lines
    const split = first && letter === "m" && numbers.length > 2 ? 2 : numbers.length;
    const put = (name: string, own: number[], at: [number, number]) =>
      parts.push(name, ...own.map((value, k) => mapped(kind, k % (count || 1), value, scale, at)));
    put(first ? "M" : letter, numbers.slice(0, split), first || letter !== kind ? [dx, dy] : [0, 0]);
    if (split < numbers.length) put("l", numbers.slice(split), [0, 0]);
  }
  return parts.length ? parts.join(" ") : null;
}

function mapped(kind: string, k: number, value: number, scale: number, [x, y]: [number, number]): string {
  if (kind === "a" && k < 5) {
    if (k < 2) return tidy(scale * value);
    return tidy(k === 2 ? -value : k === 3 ? value : 1 - value); // a reflection reverses the sense of turning
  }
  const across = kind === "h" || (kind !== "v" && (kind === "a" ? k === 5 : k % 2 === 0));
  return tidy(across ? scale * value + x : y - scale * value);
}

function tidy(value: number): string {
  return String(Number(value.toPrecision(DIGITS)) + 0);
}

/** Letters with the numbers after them. The flags of arcs must be separated from other numbers. */
function commands(d: string): [string, number[]][] {
  const found: [string, number[]][] = [];
  for (const [, letter, number] of d.matchAll(TOKEN)) {
    if (letter) found.push([letter, []]);
    else found.at(-1)?.[1].push(Number(number));
  }
  return found;
}
