// The card of the first build beside its place on the sheet, and the offer to begin it.
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { at, begin, blank, ghost, leave, phase, skip, step, tooled } from "../guide/guide";
import { STEPS } from "../guide/steps";
import { points } from "../modes/seen";
import type { Point } from "../plane/points";
import { greets } from "../store/greeting";
import { view, viewed } from "../store/sheet";
import { mode, tool } from "../store/state";
import { texts } from "../texts";
import { Button } from "./parts";

/** Distances of the card from the marks and from the edge of the sheet, px. */
const ROOM = 28;
const EDGE = 8;

export function Guide() {
  if (step.value) return <Card />;
  if (greets.value) return <Greeting />;
  if (!blank.value || tool.value || mode.value !== "edit") return null;
  return (
    <div class="guide offer">
      <Button label={texts.guide.begin} kind="main" onClick={() => void begin()} id="guide-begin" />
    </div>
  );
}

function Greeting() {
  return (
    <div class="guide offer greeting">
      <p role="status" id="greeting">
        {texts.greeting}
      </p>
    </div>
  );
}

function Card() {
  const words = texts.guide;
  const card = useRef<HTMLDivElement>(null);
  const [size, setSize] = useState({ width: 0, height: 0 });
  const { name } = step.value!;
  const last = at.value === STEPS.length - 1;
  useLayoutEffect(() => {
    const { offsetWidth: width, offsetHeight: height } = card.current!;
    if (width !== size.width || height !== size.height) setSize({ width, height });
  });
  const [left, top] = placeOf(size);
  return (
    <div ref={card} class="guide" role="group" aria-label={words.title} style={{ left: `${left}px`, top: `${top}px` }}>
      <p role="status">
        <strong>{words.count(at.value! + 1, STEPS.length)}</strong> {textOf(name)}
      </p>
      <div class="buttons">
        {last ? null : <Button label={words.skip} kind="small" onClick={skip} id="guide-skip" />}
        <Button label={last ? words.end : words.leave} kind="small" onClick={leave} id="guide-leave" />
      </div>
    </div>
  );
}

function textOf(name: keyof typeof texts.guide.steps): string {
  const words = texts.guide;
  if (phase.value === "mode") return words.mode(texts.modes[step.value!.mode]);
  const label = tooled.value?.label ?? "";
  return phase.value === "tool" ? words.tool(label, name) : words.steps[name];
}

/** The points that the card must not cover: the marks and the mechanism. */
function kept(): Point[] {
  const { at: places, line } = ghost.value ?? { at: [], line: [] };
  return [...places, ...line, ...points().map((one) => one.at)];
}

/** The place of the card, px: below these points, otherwise above, otherwise where more room is left. */
function placeOf({ width, height }: { width: number; height: number }): [number, number] {
  viewed.value;
  const places = kept().map((one) => view.toScreen(one));
  const low = view.height - height - EDGE;
  if (!places.length) return [EDGE, Math.max(EDGE, low - ROOM)];
  const [xs, ys] = [places.map(([x]) => x), places.map(([, y]) => y)];
  const middle = (Math.min(...xs) + Math.max(...xs)) / 2 - width / 2;
  const left = Math.max(EDGE, Math.min(view.width - width - EDGE, middle));
  const below = Math.max(...ys) + ROOM;
  const above = Math.min(...ys) - ROOM - height;
  if (below <= low) return [left, below];
  if (above >= EDGE) return [left, above];
  return [EDGE, Math.min(...ys) > view.height - Math.max(...ys) ? EDGE : low];
}
