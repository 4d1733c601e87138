import { expect, test, vi } from "vitest";
import type { Point } from "../src/plane/points";

vi.stubGlobal("Path2D", class {});
const { paintArrows } = await import("../src/draw/arrows");
const { View } = await import("../src/plane/view");
type Colours = Parameters<typeof paintArrows>[4];

/** Takes all painting; a letter is 7 px wide. */
const context = new Proxy(
  { measureText: (text: string) => ({ width: 7 * text.length }) },
  { get: (own, name) => (name in own ? own[name as keyof typeof own] : () => {}), set: () => true },
) as unknown as CanvasRenderingContext2D;
const colours = { named: {}, body: () => "" } as unknown as Colours;

test("texts keep off the arrows and each other", () => {
  const view = new View([-1, -1, 1, 1]);
  view.resize(600, 600);
  const values: Point[] = [
    [140, 0],
    [30, 2],
    [-80, 6],
    [0, 70],
  ];
  const vectors = values.map((value, k) => ({ element: `P${k}`, owner: "on rod", at: [0, 0] as Point, value }));
  const arrows = paintArrows(context, view, [{ kind: "force", unit: "N", pixels: 2, vectors }], [], colours);
  expect(arrows.map(({ text }) => text)[0]).toBe("140 N on rod");
  for (const { box } of arrows) {
    const [x0, y0, x1, y1] = box!;
    for (const { from, to } of arrows)
      for (let share = 0; share <= 1; share += 0.01) {
        const [x, y] = [from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])];
        expect(x > x0 && x < x1 && y > y0 && y < y1).toBe(false);
      }
    for (const { box: other } of arrows.filter((one) => one.box !== box))
      expect(x0 < other![2] && x1 > other![0] && y0 < other![3] && y1 > other![1]).toBe(false);
  }
});
