// window.kempe: the page for programs, as studio/README.md describes it.

import type { CamFound, Found, Loaded, Ran, Requests, Solved } from "../core/protocol";
import { found as cam } from "../design/cam";
import { diagrams } from "../diagrams/shown";
import { enter } from "../modes/modes";
import { course, run, valuesOf } from "../modes/read";
import type { Point } from "../plane/points";
import { open } from "../store/document";
import { send, settled } from "../store/session";
import { view } from "../store/sheet";
import { mode, pose, problems, text, unassembled } from "../store/state";

export interface Interface {
  load(given: string): Promise<{ problems: Loaded["problems"]; unassembled: Loaded["unassembled"] }>;
  toml(): Promise<string>;
  state(): Promise<{ t: number; q: number[]; v: number[] } | null>;
  quantity(name: string): Promise<{ value: number; unit: string }>;
  run(of?: number | string): Promise<Ran | Found | null>;
  values(names: string[]): Promise<{ t: number[]; units: string[]; rows: number[][] }>;
  diagrams(output?: number): Promise<object | null>;
  cam(): Promise<CamFound | null>;
  synthesis(): Promise<Solved>;
  slopes(measure: string): Promise<Requests["slopes"]["reply"]>;
  screen(point: Point): Promise<Point>;
  settled(): Promise<void>;
}

/** Resolves when all changes are drawn. The layout takes one frame, and the sheet has its new size in the next one. */
async function drawn(): Promise<void> {
  for (let frame = 0; frame < 2; frame += 1) await new Promise(requestAnimationFrame);
}

export const kempe: Interface = {
  async load(given) {
    enter("edit");
    const message = await open(given);
    if (message !== null) return { problems: [{ message }], unassembled: null };
    return { problems: problems.value, unassembled: unassembled.value };
  },
  toml: async () => text.value,
  async state() {
    const now = pose.value;
    return now && { t: now.t, q: [...now.q], v: [...now.v] };
  },
  async screen(point) {
    await drawn();
    const { left, top } = document.getElementById("sheet")!.getBoundingClientRect();
    const [x, y] = view.toScreen(point);
    return [left + x, top + y];
  },
  settled,
  diagrams,
  slopes: async (measure) => (await send("slopes", { measure })).ok,
  async cam() {
    await settled();
    return cam.value;
  },
  async synthesis() {
    let { ok } = await send("synthesis", {});
    while (ok.tried! < ok.most!) ({ ok } = await send("synthesis", { starts: 1 }));
    return ok;
  },
  quantity: async (name) => (await send("quantity", { name })).ok,
  async values(names) {
    const { units, rows } = await valuesOf(names);
    return { t: [...(course.value?.t ?? [])], units, rows: rows.map((row) => [...row]) };
  },
  async run(of) {
    const found = await run(of);
    if (found && mode.value !== "read") enter("read");
    return found;
  },
};
