// Texts of the page that depend on the motion.

import { playerTexts as texts } from "../texts";
import { byId } from "./elements";
import type { Motion } from "./motion";
import type { Scene } from "./scene";

export function showTitle({ title }: Scene, motion: Motion, decimals: number): void {
  const { name, unit, divisor } = motion.variable;
  byId("title").textContent = title || texts.linkage;
  byId("title").title = title;
  byId("variable").textContent = `${name} =`;
  if (unit !== "s") byId("now").setAttribute("aria-label", name);
  byId("end").textContent = texts.of(motion.withUnit(Number((motion.end / divisor).toFixed(decimals))));
  byId("drawing").setAttribute("aria-label", texts.drawingOf(title || texts.theLinkage));
}

/** Show the number of instants and the error between them. */
export function showSampling({ accuracy }: Scene, motion: Motion): void {
  const between = accuracy === null ? "" : texts.within(Number((100 * accuracy).toPrecision(2)));
  byId("sampling").textContent = texts.instants(motion.t.length) + (motion.smooth ? between : texts.notBetween);
}
