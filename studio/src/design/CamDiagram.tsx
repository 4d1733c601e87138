// The lift of a cam with its speed and acceleration over the angle; the knots between segments can be dragged.
import { useRef, useState } from "preact/hooks";
import type { CamFound } from "../core/protocol";
import { cam as camTexts } from "../designTexts";
import { displayed } from "../draw/display";
import { besideUnit, minus, significant } from "../draw/numbers";
import { units } from "../store/state";
import { found, segments, setSegments, sizes } from "./cam";
import { dragged, ends, levels, type Segment } from "./segments";

/** Width, and height of each strip with its gap, in units of the drawing. */
const [WIDE, HIGH, GAP] = [360, 62, 18];
const DEGREES = 180 / Math.PI;

interface Held {
  k: number;
  from: Segment[];
  /** The lift at the top of the strip. */
  top: number;
}

/** A round step of about a hundredth. */
function stepOf(top: number): number {
  return 10 ** Math.floor(Math.log10(top / 20));
}

export function CamDiagram() {
  const svg = useRef<SVGSVGElement>(null);
  const [held, setHeld] = useState<Held | null>(null);
  const of = found.value;
  if (!of) return null;
  const all = segments.value;
  const top = held?.top ?? Math.max(...levels(all), 1e-12);
  const step = stepOf(top);
  const move = (from: Segment[], k: number, angle: number, level: number) =>
    setSegments(dragged(from, k, Math.round(angle), Math.round(level / step) * step));
  const follow = ({ clientX, clientY }: PointerEvent) => {
    if (!held) return;
    const box = svg.current!.getBoundingClientRect();
    const x = ((clientX - box.left) / box.width) * WIDE;
    const y = ((clientY - box.top) / box.width) * WIDE;
    move(held.from, held.k, x, ((GAP + HIGH - y) / HIGH) * held.top);
  };
  const [at, lifts] = [ends(all), levels(all)];
  return (
    <svg
      ref={svg}
      class="cam-diagram"
      viewBox={`0 0 ${WIDE} ${3 * (HIGH + GAP) + 4}`}
      role="group"
      aria-label={camTexts.diagram}
      onPointerMove={follow}
      onPointerUp={() => setHeld(null)}
      onPointerCancel={() => setHeld(null)}
    >
      {of.undercut.map(([a, b]) => (
        <rect class="bad" x={a * DEGREES} width={Math.max(1, (b - a) * DEGREES)} y={0} height={3 * (HIGH + GAP)} />
      ))}
      {at.slice(1, -1).map((x) => (
        <line class="grid" x1={x} x2={x} y1={GAP} y2={3 * (HIGH + GAP)} />
      ))}
      <Strip k={0} of={of} values={of.diagram.s} />
      <Strip k={1} of={of} values={of.diagram.v} />
      <Strip k={2} of={of} values={of.diagram.a} />
      {all.slice(0, -1).map((_, k) => (
        <Knot
          key={k}
          k={k}
          x={at[k + 1]!}
          y={GAP + HIGH * (1 - lifts[k + 1]! / top)}
          hold={() => setHeld({ k, from: all, top })}
          push={(dx, dy) => move(all, k, at[k + 1]! + dx, lifts[k + 1]! + dy * step)}
        />
      ))}
    </svg>
  );
}

/** One curve with its name and its largest value. */
function Strip({ k, of, values }: { k: number; of: CamFound; values: number[] }) {
  const base = sizes.value.motion === "oscillating" ? "rad" : "m";
  const { factor, unit } = displayed(["", "/rad", "/rad²"].map((per) => base + per)[k]!, units.value);
  const largest = Math.max(...values.map(Math.abs), 1e-12);
  const zero = GAP + k * (HIGH + GAP) + (k ? HIGH / 2 : HIGH);
  const scale = (k ? HIGH / 2 : HIGH) / largest;
  const line = values.map((y, j) => `${(of.diagram.angle[j]! * DEGREES).toFixed(2)},${(zero - y * scale).toFixed(2)}`);
  return (
    <>
      <line class="grid" x1={0} x2={WIDE} y1={zero} y2={zero} />
      <polyline class="curve" points={line.join(" ")} />
      <text x={2} y={GAP + k * (HIGH + GAP) - 5}>
        {camTexts.strips[k]}: {camTexts.upTo} {besideUnit(minus(significant(largest * factor)), unit)}
      </text>
    </>
  );
}

interface KnotProps {
  k: number;
  x: number;
  y: number;
  hold(): void;
  push(dx: number, dy: number): void;
}

function Knot({ k, x, y, hold, push }: KnotProps) {
  const keys: Record<string, [number, number]> = {
    ArrowLeft: [-1, 0],
    ArrowRight: [1, 0],
    ArrowUp: [0, 1],
    ArrowDown: [0, -1],
  };
  return (
    <g
      class="knot"
      id={`knot-${k + 1}`}
      role="slider"
      tabindex={0}
      aria-label={camTexts.knot(k + 1)}
      aria-valuemin={0}
      aria-valuemax={WIDE}
      aria-valuenow={Math.round(x)}
      aria-valuetext={`${Math.round(x)}°`}
      onPointerDown={(event) => {
        (event.currentTarget.ownerSVGElement as SVGSVGElement).setPointerCapture(event.pointerId);
        hold();
      }}
      onKeyDown={(event) => {
        const by = keys[event.key];
        if (!by) return;
        event.preventDefault();
        event.stopPropagation();
        push(...by);
      }}
    >
      <circle class="reach" cx={x} cy={y} r={14} />
      <circle cx={x} cy={y} r={5} />
    </g>
  );
}
