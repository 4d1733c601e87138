// Changing between the modes.
import { effect } from "@preact/signals";
import { design } from "../design/handler";
import { scaling, shifting } from "../store/backdrop";
import { note } from "../store/note";
import { goHome, report, showPresent } from "../store/session";
import { loads, type Mode, message, mode, panel, tool } from "../store/state";
import { still } from "../store/still";
import { edit } from "./edit";
import type { Handler } from "./handler";
import * as living from "./live";
import { configurations, move } from "./move";
import { place, restart } from "./place";
import * as reading from "./read";
import { endScaling, scale, shift } from "./scaling";
import { beginHere } from "./starting";

export function handler(): Handler {
  if (mode.value === "edit" && scaling.value) return scale;
  if (mode.value === "edit" && shifting.value) return shift;
  if (mode.value === "edit") return tool.value ? place : edit;
  return { move, live: living.live, read: reading.read, design }[mode.value];
}

export function enter(next: Mode): void {
  if (mode.value === next) return;
  const before = mode.value;
  leave(before);
  mode.value = next;
  if (message.value?.kind === "done") message.value = null;
  if (next === "edit" || next === "design") void goHome();
  panel.value = next === "read" ? "results" : "properties";
  // With reduced motion, *Live* waits for Play.
  if (next === "live") void (before === "read" ? goHome() : Promise.resolve()).then(still() ? undefined : living.play);
  if (next === "read") {
    if (reading.course.value) reading.show(reading.time.value);
    else if (reading.found.value) void reading.showPlace(reading.place.value);
    else void (before === "move" ? beginHere() : Promise.resolve()).then(() => reading.run()).catch(report);
  }
}

function leave(before: Mode): void {
  restart(null);
  note.value = null;
  configurations.value = null;
  endScaling();
  const others = Object.keys(living.changed.value).length > 0;
  living.stop();
  if (others) void goHome();
  reading.pause();
  if (before === "read") void showPresent();
}

effect(() => {
  loads.value;
  reading.course.value = null;
  reading.found.value = null;
  reading.pause();
  living.stop();
  living.changed.value = {};
});
