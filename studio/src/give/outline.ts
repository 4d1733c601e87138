// Outlines of bodies from SVG files.
import type { Value } from "../core/protocol";
import { mappedPath } from "../edit/path";
import { change } from "../store/document";
import { announce, mechanism } from "../store/state";
import { texts } from "../texts";
import { choose } from "./choose";

/** The largest file, bytes. */
const MOST = 1024 * 1024;
const METRES: Record<string, number> = { mm: 1e-3, cm: 1e-2, in: 0.0254, pt: 0.0254 / 72, px: 0.0254 / 96 };
const MILLIMETRE = 1e-3;
const SPACE = "http://www.w3.org/2000/svg";

/** Let the user choose an SVG file whose paths become the outline of a body. */
export function openOutline(body: string): void {
  choose(".svg,image/svg+xml", async (file) => {
    const path = file.size <= MOST ? outlineOf(await file.text(), middleOfPoints(body)) : null;
    if (path === null) announce("problem", texts.outline.unreadable(file.name));
    else await change([{ path: ["bodies", body, "outline"], value: { path } as Value }]);
  });
}

/** The paths of a drawing in metres with their middle at a point; null without a path that can be read. */
function outlineOf(text: string, middle: [number, number]): string | null {
  const root = new DOMParser().parseFromString(text, "image/svg+xml").documentElement;
  const paths = [...root.querySelectorAll("path")].map((one) => one.getAttribute("d") ?? "");
  if (!paths.length || root.querySelector("[transform]")) return null;
  const box = boxOf(paths);
  const scale = metresOf(root);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const mapped = paths.map((d) => mappedPath(d, scale, [middle[0] - scale * x, middle[1] + scale * y]));
  return mapped.includes(null) ? null : mapped.join(" ");
}

/** The length of one unit of a drawing, m. It follows from the width of the drawing, otherwise it is 1 mm. */
function metresOf(root: Element): number {
  const [, number, unit] = /^([\d.]+)(mm|cm|in|pt|px)$/.exec(root.getAttribute("width") ?? "") ?? [];
  const wide = Number(root.getAttribute("viewBox")?.split(/[ ,]+/)[2]);
  const metres = Number(number) * (METRES[unit ?? ""] ?? Number.NaN);
  return metres > 0 && wide > 0 ? metres / wide : MILLIMETRE;
}

/** The rectangle around paths, as the browser draws them. */
function boxOf(paths: string[]): DOMRect {
  const svg = document.createElementNS(SPACE, "svg");
  for (const d of paths) {
    const path = document.createElementNS(SPACE, "path");
    path.setAttribute("d", d);
    svg.append(path);
  }
  document.body.append(svg);
  const box = svg.getBBox();
  svg.remove();
  return box;
}

/** The middle of the points of a body in its frame. */
function middleOfPoints(name: string): [number, number] {
  const points = Object.values(mechanism.value?.bodies.find((body) => body.name === name)?.points ?? {});
  const middle = (k: 0 | 1) => {
    const values = points.map((at) => at[k]);
    return values.length ? (Math.min(...values) + Math.max(...values)) / 2 : 0;
  };
  return [middle(0), middle(1)];
}
